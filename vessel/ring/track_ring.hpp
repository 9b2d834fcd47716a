#pragma once

#include "vessel/ring/ring_case.hpp"
#include "vessel/ring/tracked_ring.hpp"

namespace tether {

/// The ring of an opening in each frame: barycentre of its rim, normal of the rim's plane, and the turn that leads from
/// the first frame's normal and landmark to this one's; without a landmark the least turn between the normals, since a
/// rim's points cannot be told apart (Moireau et al. 2012, section 5). In the order of their times. Throws InputError
/// that names the frame: no such opening, one that has gone farther than its width since the frame before, a landmark
/// on the ring's axis, openings that no vessel has.
TrackedRing track_ring(const RingTrackCase& asked);

/// Throws InputError if a table cannot be read, or the landmark's does not tell the place at a frame's time.
void check_tables(const RingTrackCase& asked);

}  // namespace tether
