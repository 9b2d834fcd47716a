#include "diagnosis/noise/noise_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Of a function of one number, places that are close where it is large.
struct Sampling {
  double from, to, step;
  double beside_best;  ///< how close places are to the best one at least
  double closest;
};

constexpr double matters = 6;   ///< below the best by more than that, e^-6, needs no closer look
constexpr double one_step = 1;  ///< by which the logarithm may change between places that matter

std::map<double, double> sampled(const Sampling& how, const std::function<double(double)>& value) {
  std::map<double, double> known;
  const int steps = std::max(2, static_cast<int>(std::ceil((how.to - how.from) / how.step)));
  for (int i = 0; i <= steps; ++i) {
    const double x = how.from + (how.to - how.from) * i / steps;
    known[x] = value(x);
  }
  while (true) {
    const auto best =
        std::max_element(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::vector<double> wanted;
    for (auto a = known.begin(), b = std::next(a); b != known.end(); ++a, ++b) {
      const double apart = b->first - a->first;
      if (apart < 2 * how.closest || std::max(a->second, b->second) < best->second - matters) continue;
      const bool is_beside = a == best || b == best;
      if (std::abs(a->second - b->second) > one_step || (is_beside && apart > how.beside_best))
        wanted.push_back((a->first + b->first) / 2);
    }
    if (wanted.empty()) return known;
    for (const double x : wanted) known[x] = value(x);
  }
}

/// Of a length this many times shorter than the places are apart no two of them are alike: shorter ones look the same.
constexpr double white = 4;
constexpr Sampling logits{-7, 3, 0.5, 0.25, 0.03};  // nuggets of 0.001 to 0.95

double nugget_of(double logit) {
  return 1 / (1 + std::exp(-logit));
}

/// Widths of the cells around ascending places.
VectorXd widths_of(const std::vector<double>& places) {
  const auto n = static_cast<Index>(places.size());
  VectorXd width(n);
  for (Index i = 0; i < n; ++i)
    width(i) = (places[static_cast<std::size_t>(std::min(i + 1, n - 1))] -
                places[static_cast<std::size_t>(std::max<Index>(i - 1, 0))]) /
               2;
  return width;
}

/// The value below which this share of the weights lies, linear between the cells' limits.
double quantile(const std::map<double, double>& weights, double share) {
  std::vector<double> places, limits;
  for (const auto& [x, weight] : weights) places.push_back(x);
  limits.push_back(places.front());
  for (std::size_t i = 0; i + 1 < places.size(); ++i) limits.push_back((places[i] + places[i + 1]) / 2);
  limits.push_back(places.back());
  double below = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double weight = weights.at(places[i]);
    if (below + weight >= share)
      return limits[i] + (limits[i + 1] - limits[i]) * (weight > 0 ? (share - below) / weight : 0);
    below += weight;
  }
  return places.back();
}

MeasuredNumber interval(const std::map<double, double>& weights, const std::function<double(double)>& value) {
  return {value(quantile(weights, 0.5)), value(quantile(weights, 0.025)), value(quantile(weights, 0.975))};
}

/// Distances between a place and its nearest neighbour, the middle one; and the largest of all.
std::pair<double, double> spacing_and_extent(const std::vector<NoiseField>& fields) {
  std::vector<double> nearest;
  double extent = 0;
  for (const NoiseField& field : fields)
    for (Index i = 0; i < field.places.cols(); ++i) {
      VectorXd apart = (field.places.colwise() - field.places.col(i)).colwise().norm();
      extent = std::max(extent, apart.maxCoeff());
      apart(i) = apart.maxCoeff();
      nearest.push_back(apart.minCoeff());
    }
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2), nearest.end());
  return {nearest[nearest.size() / 2], extent};
}

}  // namespace

NoisePosterior::NoisePosterior(const RestrictedLikelihood& likelihood, CorrelationShape shape)
    : likelihood_(likelihood), shape_(shape) {
  const auto [spacing, extent] = spacing_and_extent(likelihood.fields());
  longest_ = std::log(extent);
  const Sampling lengths{std::log(spacing / white), longest_, 0.6, 0.16, 0.02};
  std::vector<double> log_lengths;
  for (const auto& [log_length, value] : sampled(lengths, [&](double x) { return add_slice(x); }))
    log_lengths.push_back(log_length);
  weigh(log_lengths);
}

double NoisePosterior::add_slice(double log_length) {
  const auto slice = likelihood_.slice(shape_, std::exp(log_length));
  std::map<double, RestrictedSums> sums;
  const auto known = sampled(
      logits, [&](double logit) { return likelihood_.log_likelihood(sums[logit] = slice.at(nugget_of(logit))); });
  std::vector<double> places;
  for (const auto& [logit, value] : known) places.push_back(logit);
  const VectorXd width = widths_of(places);
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double nugget = nugget_of(places[i]), value = known.at(places[i]);
    nodes_.push_back(
        {log_length, nugget, sums[places[i]], value, width(static_cast<Index>(i)) * std::sqrt(nugget) * (1 - nugget)});
    best = std::max(best, value);
  }
  return best;
}

void NoisePosterior::weigh(const std::vector<double>& log_lengths) {
  const VectorXd width = widths_of(log_lengths);
  const double best = log_likelihood();
  double sum = 0;
  for (Node& node : nodes_) {
    const auto place = std::lower_bound(log_lengths.begin(), log_lengths.end(), node.log_length);
    node.weight *= width(place - log_lengths.begin()) * std::exp(node.log_likelihood - best);
    sum += node.weight;
  }
  for (Node& node : nodes_) node.weight /= sum;
}

MeasuredNumber NoisePosterior::length() const {
  std::map<double, double> weights;
  for (const Node& node : nodes_) weights[node.log_length] += node.weight;
  return interval(weights, [](double x) { return std::exp(x); });
}

MeasuredNumber NoisePosterior::nugget() const {
  std::map<double, double> weights;
  for (const Node& node : nodes_) weights[node.nugget] += node.weight;
  return interval(weights, [](double x) { return x; });
}

/// Given length and nugget, `squares` over the variance is chi-square: the logarithm of the deviation is nearly normal.
MeasuredNumber NoisePosterior::deviation() const {
  const auto n = static_cast<double>(likelihood_.count());
  const double spread = 1 / std::sqrt(2 * n);
  const auto below = [&](double log_deviation) {
    double sum = 0;
    for (const Node& node : nodes_)
      sum += node.weight * normal_tail((0.5 * std::log(node.sums.squares / n) - log_deviation) / spread);
    return sum;
  };
  const auto at = [&](double share) {
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (const Node& node : nodes_) {
      const double middle = 0.5 * std::log(node.sums.squares / n);
      from = std::min(from, middle - 5 * spread), to = std::max(to, middle + 5 * spread);
    }
    for (int i = 0; i < 50; ++i) (below((from + to) / 2) < share ? from : to) = (from + to) / 2;
    return std::exp(from);
  };
  return {at(0.5), at(0.025), at(0.975)};
}

NoiseFit NoisePosterior::fit() const {
  return {shape_, deviation(), length(), nugget(), log_likelihood()};
}

bool NoisePosterior::reaches_end() const {
  return std::log(length().upper) > longest_ - 0.3;
}

double NoisePosterior::log_likelihood() const {
  return std::max_element(nodes_.begin(), nodes_.end(),
                          [](const Node& a, const Node& b) { return a.log_likelihood < b.log_likelihood; })
      ->log_likelihood;
}

double NoisePosterior::log_likelihood_with(std::optional<double> deviation, std::optional<double> length) const {
  const auto value = [&](const RestrictedSums& sums) {
    return deviation ? likelihood_.log_likelihood(sums, *deviation) : likelihood_.log_likelihood(sums);
  };
  double best = -std::numeric_limits<double>::infinity();
  if (!length) {
    for (const Node& node : nodes_) best = std::max(best, value(node.sums));
    return best;
  }
  const auto slice = likelihood_.slice(shape_, *length);
  for (const auto& [logit, likelihood] : sampled(logits, [&](double at) { return value(slice.at(nugget_of(at))); }))
    best = std::max(best, likelihood);
  return best;
}

}  // namespace tether
