#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vessel/anatomy/anatomy.hpp"

namespace tether {

/// How thick a wall is: a length, or a share of the lumen's radius there.
struct Thickness {
  std::optional<double> length;              ///< [length]
  std::optional<double> fraction_of_radius;  ///< counts where there is no length
};

/// Of a tree: the same everywhere, but for some branches.
struct TreeThickness {
  Thickness everywhere;
  std::vector<std::pair<std::string, Thickness>> branches;
  /// The way along the surface over which it changes about a junction [length]; none: the radius of the branch where it
  /// begins.
  std::optional<double> blend;
};

/// The thickness at places of the lumen's surface [length]. Near a junction it is the mean of the branches' by weights
/// that go from 1 to 0, smoothly, over the way `blend` about it (M.5). Throws InputError for the name of a branch that
/// does not exist.
VectorXd thickness_at(const Points& places, const TreeThickness& thickness, const Anatomy& anatomy);

}  // namespace tether
