#include "diagnosis/search/misfit_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/search/spread_points.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr Index centres = 60, finer_centres = 240;
constexpr std::array sizes{1.0, 2.0, 4.0};  ///< radii, in the length over which errors are alike
constexpr int per_patch = 3;                ///< amplitudes
constexpr double within = 5.99;     ///< gain that 95 % of the possible centres are within: chi-square, two numbers
constexpr double unseen = 1e-9;     ///< information of one amplitude over that of another
constexpr double noteworthy = 0.1;  ///< share of a patch

/// To the nearest of the points that is another one: no place is known better.
double spacing_about(const Vec3& place, const Points& points) {
  double spacing = std::numeric_limits<double>::infinity();
  for (const auto& point : points.colwise())
    if (const double distance = (point - place).norm(); distance > 0) spacing = std::min(spacing, distance);
  return std::isfinite(spacing) ? spacing : 0;
}

/// z of a chi-square of three numbers.
double significance_of(double gain) {
  return gain > 0 ? -normal_quantile(std::clamp(chi_square_tail(gain, per_patch), 1e-300, 0.5)) : 0;
}

}  // namespace

MisfitMap::MisfitMap(const Evidence& evidence, const Whitening& whitening, const EffectProblem& problem, double start,
                     double end)
    : evidence_(evidence), whitening_(whitening), trained_(naming(problem)), start_(start), duration_(end - start) {
  Index first = -1, count = 0;
  for (const Evidence::Part& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    times_.push_back(part.time);
    smallest_ = std::max(smallest_, evidence.noise(part).correlation_length);
    for (Index i = part.first; i < part.first + part.count; ++i) rows_.push_back(i);
    if (part.count > count) first = part.first, count = part.count;
  }
  if (first >= 0) places_ = evidence.places().middleCols(first, count);
  waves_.resize(evidence.places().cols(), per_patch);
  for (Index i = 0; i < waves_.rows(); ++i) {
    const double angle = phase(evidence.times()[static_cast<std::size_t>(i)]);
    waves_.row(i) << 1, std::cos(angle), std::sin(angle);
  }
  if (smallest_ == 0 && count > 0)
    smallest_ = (places_.rowwise().maxCoeff() - places_.rowwise().minCoeff()).norm() / 20;
}

double MisfitMap::phase(double time) const {
  return 2 * std::numbers::pi * (time - start_) / duration_;
}

VectorXd MisfitMap::bump(const Vec3& centre, double radius) const {
  VectorXd result = VectorXd::Zero(evidence_.places().cols());
  for (const Index i : rows_)
    result(i) = std::exp(-(evidence_.places().col(i) - centre).squaredNorm() / (2 * radius * radius));
  return result;
}

std::vector<MisfitMap::Patch> MisfitMap::patches(const Points& about, double radius, const VectorXd& left) const {
  constexpr Index at_once = 30;  // so many columns whiten faster together
  std::vector<Patch> all;
  for (Index first = 0; first < about.cols(); first += at_once) {
    const Index count = std::min(at_once, about.cols() - first);
    MatrixXd columns(waves_.rows(), per_patch * count);
    for (Index k = 0; k < count; ++k)
      columns.middleCols<per_patch>(per_patch * k) =
          waves_.array().colwise() * bump(about.col(first + k), radius).array();
    const Scores scores = trained_.scores(whitening_(columns), left);
    for (Index k = 0; k < count; ++k) {
      const Mat3 information = scores.information.block<per_patch, per_patch>(per_patch * k, per_patch * k);
      const Vec3 response = scores.response.segment<per_patch>(per_patch * k);
      const Eigen::LDLT<Mat3> factor(information);
      all.emplace_back();
      if (factor.info() != Eigen::Success || !(factor.rcond() > unseen)) continue;
      all.back().amplitudes = factor.solve(response);
      all.back().gain = response.dot(all.back().amplitudes);
    }
  }
  return all;
}

VectorXd MisfitMap::significance(const Points& places, double radius, const VectorXd& left) const {
  const Points about = spread(places_, finer_centres);
  const std::vector<Patch> found = patches(about, radius, left);
  VectorXd result(places.cols());
  for (Index i = 0; i < places.cols(); ++i) {
    Index nearest = 0;
    (about.colwise() - places.col(i)).colwise().squaredNorm().minCoeff(&nearest);
    result(i) = significance_of(found[static_cast<std::size_t>(nearest)].gain);
  }
  return result;
}

std::optional<LocatedMisfit> MisfitMap::worst(const VectorXd& left) const {
  if (places_.cols() == 0) return std::nullopt;
  Patch best;
  LocatedMisfit found;
  const auto consider = [&](const Points& about, double radius) {
    const std::vector<Patch> all = patches(about, radius, left);
    VectorXd gains(about.cols());
    for (Index k = 0; k < about.cols(); ++k) {
      const Patch& patch = all[static_cast<std::size_t>(k)];
      gains(k) = patch.gain;
      if (patch.gain <= best.gain) continue;
      best = patch;
      found.radius = radius;
      found.centre = about.col(k);
    }
    return gains;
  };
  const Points about = spread(places_, centres), finer = spread(places_, finer_centres);
  for (const double size : sizes) consider(about, size * smallest_);
  if (best.gain == 0) return std::nullopt;
  const VectorXd gains = consider(finer, found.radius);
  found.resolution = spacing_about(found.centre, finer);
  for (Index k = 0; k < finer.cols(); ++k)
    if (gains(k) > best.gain - within)
      found.resolution = std::max(found.resolution, (finer.col(k) - found.centre).norm());
  const auto tried =
      static_cast<double>(finer.cols()) + static_cast<double>(sizes.size()) * static_cast<double>(about.cols());
  found.z = significance_of(best.gain);
  found.p = std::min(1.0, tried * chi_square_tail(best.gain, per_patch));
  set_greatest(found, best.amplitudes);
  set_regions(found);
  return found;
}

void MisfitMap::set_greatest(LocatedMisfit& found, const Vec3& amplitudes) const {
  for (const double time : times_) {
    const double amount = amplitudes.dot(Vec3(1, std::cos(phase(time)), std::sin(phase(time))));
    if (std::abs(amount) < std::abs(found.amount)) continue;
    found.amount = amount;
    found.time = time;
  }
}

void MisfitMap::set_regions(LocatedMisfit& found) const {
  const VectorXd shape = bump(found.centre, found.radius);
  std::map<int, double> shares;
  for (const Index i : rows_) shares[evidence_.regions()[static_cast<std::size_t>(i)]] += shape(i);
  for (const auto& [region, share] : shares)
    if (region >= 0 && share > noteworthy * shape.sum())
      found.regions.push_back({evidence_.region_names()[static_cast<std::size_t>(region)], share / shape.sum()});
  std::sort(found.regions.begin(), found.regions.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
}

}  // namespace tether
