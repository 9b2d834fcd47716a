#pragma once

#include "vessel/surface/raw_surface.hpp"

/// Steps of a repair that need no geometry kernel. Each adds a note where it does something, and throws PlacedError for
/// what it cannot mend.
namespace tether {

/// Makes points within `tolerance` [cm] of each other one; drops triangles that lose a corner by it, or are there
/// twice.
void merge_points(Repaired& state, double tolerance);

/// Drops patches that hang on edges of three or more triangles, the smallest first, each of at most a tenth of the
/// area.
void drop_fins(Repaired& state);

/// Keeps the piece with the largest area.
void keep_largest_piece(Repaired& state);

/// Gives each of several fans of triangles at one point its own.
void split_points(Repaired& state);

/// Turns triangles such that all look outward.
void orient(Repaired& state);

/// The volume within, rims closed by fans [cm3]; negative if the triangles look inward.
double enclosed_volume(const RawSurface& surface);

}  // namespace tether
