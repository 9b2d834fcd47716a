#include "vessel/image/smooth_field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tether {
namespace {

/// Its sum is 1, its second moment 0.
std::vector<double> kernel(double deviation) {
  const int half = static_cast<int>(std::ceil(3.5 * deviation)), twice = 2 * half;
  std::vector<double> once(static_cast<std::size_t>(twice) + 1), result(2 * static_cast<std::size_t>(twice) + 1, 0.0);
  for (int place = 0; place <= twice; ++place) {
    const double i = place - half;
    once[static_cast<std::size_t>(place)] = std::exp(-0.5 * i * i / (deviation * deviation));
  }
  const double sum = std::accumulate(once.begin(), once.end(), 0.0);
  for (double& weight : once) weight /= sum;
  for (std::size_t i = 0; i < once.size(); ++i) {
    result[i + static_cast<std::size_t>(twice - half)] += 2 * once[i];
    for (std::size_t j = 0; j < once.size(); ++j) result[i + j] -= once[i] * once[j];  // (M.20)
  }
  return result;
}

/// One line of voxels, `stride` apart.
void smooth_line(float* first, std::size_t stride, int count, const std::vector<double>& weights,
                 std::vector<float>& padded) {
  const int half = static_cast<int>(weights.size() / 2);
  padded.resize(static_cast<std::size_t>(count) + 2 * static_cast<std::size_t>(half));
  for (int i = 0; i < count + 2 * half; ++i)
    padded[static_cast<std::size_t>(i)] = first[stride * static_cast<std::size_t>(std::clamp(i - half, 0, count - 1))];
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    first[stride * i] = static_cast<float>(
        std::inner_product(weights.begin(), weights.end(), padded.begin() + static_cast<std::ptrdiff_t>(i), 0.0));
}

}  // namespace

void smooth_field(ImageVolume& field, double deviation) {
  if (deviation <= 0) return;
  const std::vector<double> weights = kernel(deviation);
  std::vector<float> padded;
  const auto [nx, ny, nz] = field.count;
  float* values = field.values.data();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) smooth_line(values + field.at(0, j, k), 1, nx, weights, padded);
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i) smooth_line(values + field.at(i, 0, k), field.at(0, 1, 0), ny, weights, padded);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) smooth_line(values + field.at(i, j, 0), field.at(0, 0, 1), nz, weights, padded);
}

}  // namespace tether
