#include "diagnosis/results/packed_floats.hpp"

#include <cstring>

#include "common/base/base64.hpp"
#include "common/base/error.hpp"

namespace tether {
namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

PackedFloats packed(const MatrixXd& numbers) {
  const RowMajor rows = numbers.cast<float>();
  return {{static_cast<int>(numbers.rows()), static_cast<int>(numbers.cols())},
          base64(rows.data(), sizeof(float) * static_cast<std::size_t>(rows.size()))};
}

MatrixXd unpacked(const PackedFloats& packed) {
  const std::string bytes = from_base64(packed.float32);
  if (packed.shape.size() != 2 || packed.shape[0] < 0 || packed.shape[1] < 0)
    throw input_error("packed numbers have no rows and columns");
  const auto count = static_cast<std::size_t>(packed.shape[0]) * static_cast<std::size_t>(packed.shape[1]);
  if (bytes.size() % sizeof(float) != 0 || bytes.size() / sizeof(float) != count)
    throw input_error("{} bytes are not {} x {} numbers", bytes.size(), packed.shape[0], packed.shape[1]);
  RowMajor rows(packed.shape[0], packed.shape[1]);
  std::memcpy(rows.data(), bytes.data(), bytes.size());
  return rows.cast<double>();
}

}  // namespace tether
