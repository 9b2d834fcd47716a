#pragma once

#include <string>
#include <vector>

#include "common/catalogue/extent.hpp"

namespace tether {

/// An effect of the catalogue on a part of the wall, by where the case with all candidates has it.
struct PlacedEffect {
  std::string path, type, part, meaning;
  bool is_new = false;                ///< the case itself does not have it
  std::vector<std::string> required;  ///< numbers that must be given for it
  std::string variant_of = {};        ///< the effect that it is a special shape of; empty: of none
  Extent extent = {};                 ///< of the part, which of it the effect acts on
  std::string length = {};            ///< unit of the extent
  std::string mostly_in = {};         ///< of a patch without a part, the region that has more than half of it
  double one_of = 1;                  ///< how many such patches the wall has
  bool is_tried = false;              ///< on one of several patches that are compared
};

}  // namespace tether
