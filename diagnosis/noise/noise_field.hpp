#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What was seen of errors at one moment.
struct NoiseFrame {
  VectorXd values;  ///< errors, and what is left free [n]
  MatrixXd shared;  ///< columns whose amplitudes are the same in all frames of all fields [n x k]
  double time = 0;
};

/// Errors at the same places at several moments, each independent of the others.
struct NoiseField {
  Points places;  ///< [length]
  MatrixXd free;  ///< columns that may have any amplitude in each frame [n x p]
  std::vector<NoiseFrame> frames;
};

/// At most so many places of each field, drawn at random: near ones and far ones. The same every time.
std::vector<NoiseField> thinned(std::vector<NoiseField> fields, Eigen::Index most);

/// A uniform offset and a rigid shift, of distances along the normals [n x 4]. Normals are averaged over the places
/// near each: those of data are rough with their errors, and columns that know these would take them out.
MatrixXd offset_and_shift(const Points& places, const Points& normals);

/// Columns averaged over the places near each in the same way: what a motion does to distances from data is rough with
/// their errors, too.
MatrixXd averaged(const Points& places, const MatrixXd& columns);

}  // namespace tether
