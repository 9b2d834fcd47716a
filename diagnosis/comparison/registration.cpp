#include "diagnosis/comparison/registration.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr double hardly_seen = 0.03;  ///< of the best seen direction's information: a round tube about its axis
constexpr double mostly = 0.5;        ///< of the mean square distance
constexpr double by_chance = 1e-6;

struct Sums {
  Vec3 centre{0, 0, 0};
  double weight = 0, squares = 0, radius = 0;  ///< radius: root mean square distance from the centre
};

Sums sums_of(const std::vector<Sample>& samples) {
  Sums sums;
  for (const Sample& s : samples) {
    sums.weight += s.weight;
    sums.centre += s.weight * s.position;
    sums.squares += s.weight * s.distance * s.distance;
  }
  if (!(sums.weight > 0)) return sums;
  sums.centre /= sums.weight;
  for (const Sample& s : samples) sums.radius += s.weight * (s.position - sums.centre).squaredNorm();
  sums.radius = std::sqrt(sums.radius / sums.weight);
  return sums;
}

}  // namespace

bool Registration::stands_out() const {
  return after * after < (1 - mostly) * before * before && chi_square_tail(significance, 6) < by_chance;
}

std::optional<Registration> registration_of(const std::vector<Sample>& samples, double deviation, double independent) {
  const Sums sums = sums_of(samples);
  if (!(sums.weight > 0 && sums.radius > 0 && deviation > 0)) return std::nullopt;
  Mat6 information = Mat6::Zero();
  Vec6 response = Vec6::Zero();
  for (const Sample& s : samples) {
    const Vec3 arm = (s.position - sums.centre) / sums.radius;  // rotations as lengths at that radius
    const Vec6 row = (Vec6() << s.normal, arm.cross(s.normal)).finished();
    information += s.weight * row * row.transpose();
    response += s.weight * s.distance * row;
  }
  const Eigen::SelfAdjointEigenSolver<Mat6> eigen(information);
  const Vec6& values = eigen.eigenvalues();
  const Vec6 along = eigen.eigenvectors().transpose() * response;
  Vec6 motion = Vec6::Zero();
  double explained = 0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (!(values(k) > hardly_seen * values(5))) continue;
    motion += along(k) / values(k) * eigen.eigenvectors().col(k);
    explained += along(k) * along(k) / values(k);
  }
  return Registration{{motion.head<3>(), motion.tail<3>() / sums.radius, sums.centre},
                      std::sqrt(sums.squares / sums.weight),
                      std::sqrt(std::max(0.0, sums.squares - explained) / sums.weight),
                      explained / sums.weight * independent / (deviation * deviation)};
}

}  // namespace tether
