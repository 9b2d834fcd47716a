#pragma once

namespace tether {

/// Radii of openings that are taken for a vessel's [cm]: a newborn's aorta is 6 mm wide, a giant aneurysm 12 cm.
inline constexpr double least_vessel_radius = 0.25, most_vessel_radius = 6;

}  // namespace tether
