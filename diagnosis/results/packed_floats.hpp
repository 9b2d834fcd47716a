#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Numbers that are too many for text: single precision, little-endian, in base 64.
struct PackedFloats {
  static constexpr const char* type_name = "packed_floats";
  std::vector<int> shape;
  std::string float32;

  static void fields(auto& self, auto&& field) {
    field("shape", self.shape, "rows and columns");
    field("float32", self.float32, "row by row, little-endian, in base 64");
  }
};

PackedFloats packed(const MatrixXd& numbers);
/// Throws InputError if the shape is not that of the numbers.
MatrixXd unpacked(const PackedFloats& packed);

}  // namespace tether
