#include "diagnosis/evidence/set_evidence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;
using Members = std::vector<std::size_t>;

/// Of places on the axis of amplitudes: a = scale sinh(x)/50, even in the logarithm of what is large.
constexpr double farthest_place = 9, apart = 0.2, seen_from = 0.02;
/// Of a logarithm of evidence: what is less probable than the best by this does not count.
constexpr double negligible = 10;
constexpr Index across = 14;    ///< places across what counts
constexpr Index resolved = 5;   ///< places that count: fewer, and the density is theirs and not that of the data
constexpr int most_rounds = 5;  ///< each with places some six times as close
/// Multiples of the scale that amplitudes of a vector may have, alike probable.
constexpr std::array multiples{0.3, 1.0, 3.0, 10.0};
constexpr double anything = 1e4;  ///< of an amplitude without prior, over what the data tell of it

/// Falls as a power of the value: of any order of magnitude, none favoured.
double prior_density(const Amplitude& amplitude, double size, double scale) {
  constexpr double deviation = std::numbers::sqrt2;  // of exp(-|x|)
  if (amplitude.doubles) return std::exp(-deviation * std::abs(size) / scale) * deviation / (2 * scale);
  return 1 / (std::numbers::pi * scale * (1 + std::pow(size / scale, 2)));
}

double normal_density(double size, double deviation) {
  return std::exp(-0.5 * std::pow(size / deviation, 2)) / (std::sqrt(2 * std::numbers::pi) * deviation);
}

double log_sum(const VectorXd& logs) {
  const double most = logs.maxCoeff();
  return std::isfinite(most) ? most + std::log((logs.array() - most).exp().sum()) : most;
}

/// I + D G D = L L': what errors of deviations D along some of the columns leave of the others.
struct Taken {
  MatrixXd gram;
  double log_norm;
};
Taken take_out(const MatrixXd& gram, const MatrixXd& among, const MatrixXd& across, const VectorXd& deviations) {
  const MatrixXd one = MatrixXd::Identity(among.rows(), among.cols());
  const Eigen::LLT<MatrixXd> factor(one + deviations.asDiagonal() * among * deviations.asDiagonal());
  const MatrixXd along = factor.matrixL().solve(deviations.asDiagonal() * across);
  return {gram - along.transpose() * along, factor.matrixLLT().diagonal().array().log().sum()};
}

std::vector<DiscrepancySize> sizes_of(bool may_differ) {
  if (!may_differ) return {{0, 1}};
  constexpr std::array small{0.1, 0.2, 0.4, 0.7, 1.0};
  constexpr std::array large{2.0, 4.0, 8.0, 16.0, 32.0};
  constexpr double outside = 0.1;  // beforehand
  std::vector<DiscrepancySize> all;
  for (const double size : small) all.push_back({size, (1 - outside) / small.size()});
  for (const double size : large) all.push_back({size, outside / large.size()});
  return all;
}

}  // namespace

SetEvidence::SetEvidence(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Assumptions& assumed)
    : SetEvidence(problem, runs, assumed, naming_rows(problem)) {}

SetEvidence::SetEvidence(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Assumptions& assumed,
                         const std::vector<Index>& rows)
    : problem_(problem),
      assumed_(assumed),
      discrepancies_(sizes_of(problem.pattern_deviation.size() > 0)),
      curves_(problem.candidates.size()) {
  MatrixXd columns = problem.changes(rows, Eigen::all);
  const auto append = [&](const VectorXd& column) {
    columns.conservativeResize(columns.rows(), columns.cols() + 1);
    columns.rightCols(1) = column(rows);
  };
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    if (!is_scalar(c)) continue;
    const Index own = problem.candidates[c].amplitudes.front();
    curves_[c].resize(2);
    const auto add = [&](const AmplitudeCurve::Point& point) { curves_[c][point.size > 0 ? 0 : 1].add(point); };
    if (const Amplitude& amplitude = amplitude_of({c}); amplitude.step != 0)
      add({amplitude.step, own, amplitude.step, amplitude.is_coarse});
    for (const ShownRun& run : runs)
      if (run.amplitudes(own) != 0 && (run.amplitudes.array() != 0).count() == 1 && run.residual.allFinite()) {
        add({run.amplitudes(own), columns.cols(), 1, run.is_coarse});
        append(problem.residual - run.residual);
      }
    for (AmplitudeCurve& side : curves_[c]) side.settle(columns, problem.precision(rows));
  }
  append(problem.residual);

  std::vector<Index> ordinary;
  for (Index k = 0; k < problem.allowed.cols(); ++k)
    if (std::count(problem.allowed_patterns.begin(), problem.allowed_patterns.end(), k) == 0) ordinary.push_back(k);
  const Index own = static_cast<Index>(ordinary.size());
  const Index patterns = problem.pattern_deviation.size();
  MatrixXd errors(columns.rows(), own + patterns);
  errors << problem.allowed(rows, ordinary), problem.patterns(rows, Eigen::seqN(0, patterns));
  const VectorXd root = problem.precision(rows).cwiseSqrt() / assumed.noise;
  errors = root.asDiagonal() * errors;
  columns = root.asDiagonal() * columns;
  const MatrixXd among = errors.transpose() * errors, across = errors.transpose() * columns,
                 gram = columns.transpose() * columns;
  VectorXd deviations(errors.cols());
  for (Index k = 0; k < own; ++k) {
    const double given = problem.allowed_deviation(ordinary[static_cast<std::size_t>(k)]);
    deviations(k) = std::isfinite(given) ? given : among(k, k) > 0 ? anything / std::sqrt(among(k, k)) : 0;
  }
  for (const DiscrepancySize& discrepancy : discrepancies_) {
    deviations.tail(patterns) = assumed.discrepancy * discrepancy.size * problem.pattern_deviation;
    Taken taken = take_out(gram, among, across, deviations);
    products_.push_back({std::move(taken.gram), taken.log_norm});
  }
}

double SetEvidence::scale_of(const Amplitude& amplitude) const {
  return assumed_.sizes * (amplitude.scale > 0 && std::isfinite(amplitude.scale) ? amplitude.scale : 1);
}

bool SetEvidence::is_scalar(std::size_t candidate) const {
  return problem_.candidates[candidate].amplitudes.size() == 1;
}

const Amplitude& SetEvidence::amplitude_of(const Summand& summand) const {
  const auto& own = problem_.candidates[summand.candidate].amplitudes;
  return problem_.amplitudes[static_cast<std::size_t>(own[static_cast<std::size_t>(summand.number)])];
}

/// The residual is the last.
std::vector<Index> SetEvidence::columns_of(const Members& members) const {
  std::vector<Index> columns;
  for (const std::size_t c : members) {
    const auto& own = problem_.candidates[c].amplitudes;
    columns.insert(columns.end(), own.begin(), own.end());
    for (const AmplitudeCurve& side : curves_[c])
      for (const AmplitudeCurve::Point& point : side.points())
        if (point.column != own.front()) columns.push_back(point.column);
  }
  columns.push_back(products_.front().gram.cols() - 1);
  return columns;
}

/// To first order where no run was made.
VectorXd SetEvidence::mix_at(const Summand& summand, double size, const std::vector<Index>& columns) const {
  VectorXd mix = VectorXd::Zero(static_cast<Index>(columns.size()));
  const auto place_of = [&](Index column) {
    return std::find(columns.begin(), columns.end(), column) - columns.begin();
  };
  const auto& all = problem_.candidates[summand.candidate].amplitudes;
  const Index own = place_of(all[static_cast<std::size_t>(summand.number)]);
  if (!is_scalar(summand.candidate)) return size * VectorXd::Unit(mix.size(), own);
  const AmplitudeCurve& side = curves_[summand.candidate][size > 0 ? 0 : 1];
  if (side.points().empty()) mix(own) = size;
  for (const AmplitudeCurve::Share& part : side.at(size))
    mix(place_of(part.point->column)) += part.share * part.point->factor;
  return mix;
}

SetEvidence::Grid SetEvidence::grid_of(const Summand& summand, const std::vector<Index>& columns,
                                       const VectorXd& places) const {
  const Amplitude& amplitude = amplitude_of(summand);
  const double assumed = scale_of(amplitude), scale = assumed / assumed_.sizes, between = places(1) - places(0);
  Grid grid{VectorXd(places.size()), VectorXd(places.size()), MatrixXd(places.size(), columns.size())};
  for (Index g = 0; g < places.size(); ++g) {
    const double size = scale * seen_from * std::sinh(places(g)), way = scale * seen_from * std::cosh(places(g));
    const bool admissible = size != 0 && std::abs(amplitude.limited(size) - size) <= 1e-9 * std::abs(size);
    const double density = summand.deviation > 0
                               ? normal_density(size, summand.deviation)
                               : (amplitude.one_sided ? 2 : 1) * prior_density(amplitude, size, assumed);
    grid.sizes(g) = size;
    grid.log_weight(g) = admissible ? std::log(density * way * between) : -infinite;
    grid.mix.row(g) = mix_at(summand, admissible ? size : scale, columns);
  }
  return grid;
}

namespace {

VectorXd all_places(const Amplitude& amplitude, bool few) {
  const double between = few ? 2.5 * apart : apart;
  const auto half = static_cast<Index>(farthest_place / between);
  const double end = static_cast<double>(half) * between;
  return amplitude.one_sided ? VectorXd::LinSpaced(half, between, end) : VectorXd::LinSpaced(2 * half + 1, -end, end);
}

bool is_resolved(const VectorXd& logs) {
  return (logs.array() > logs.maxCoeff() - negligible).count() >= resolved;
}

/// Places across those whose logarithms are near the largest.
VectorXd where_it_counts(const VectorXd& places, const VectorXd& logs) {
  const double least = logs.maxCoeff() - negligible, between = places(1) - places(0);
  Index first = places.size(), last = 0;
  for (Index g = 0; g < places.size(); ++g)
    if (logs(g) > least) first = std::min(first, g), last = g;
  return VectorXd::LinSpaced(across, places(first) - between, places(last) + between);
}

/// Of up to three amplitudes: the logarithm of the integrand summed over all, and over all others for each.
struct Summed {
  double all;
  std::vector<VectorXd> each;
};

Summed summed(const std::vector<VectorXd>& alone, const std::vector<std::vector<MatrixXd>>& together) {
  const std::size_t n = alone.size();
  if (n == 1) return {log_sum(alone[0]), {alone[0]}};
  const MatrixXd pair = (-together[0][1]).colwise() + alone[0];
  if (n == 2) {
    const MatrixXd both = pair.rowwise() + alone[1].transpose();
    const double most = both.maxCoeff();
    if (!std::isfinite(most)) return {most, {alone[0], alone[1]}};
    const MatrixXd weights = (both.array() - most).exp();
    const VectorXd first = weights.rowwise().sum().array().log() + most,
                   second = weights.colwise().sum().transpose().array().log() + most;
    return {most + std::log(weights.sum()), {first, second}};
  }
  VectorXd first = VectorXd::Constant(alone[0].size(), -infinite);
  MatrixXd rest(alone[1].size(), alone[2].size());
  double most = -infinite;
  std::vector<MatrixXd> slices;
  for (Index i = 0; i < alone[0].size(); ++i) {
    rest = (-together[1][2]).colwise() + (alone[1] - together[0][1].row(i).transpose());
    rest.rowwise() += (alone[2] - together[0][2].row(i).transpose()).transpose();
    rest.array() += alone[0](i);
    most = std::max(most, rest.maxCoeff());
    slices.push_back(rest);
  }
  VectorXd second = VectorXd::Zero(alone[1].size()), third = VectorXd::Zero(alone[2].size());
  for (Index i = 0; i < alone[0].size(); ++i) {
    const MatrixXd weights = (slices[static_cast<std::size_t>(i)].array() - most).exp();
    first(i) = most + std::log(weights.sum());
    second += weights.rowwise().sum();
    third += weights.colwise().sum().transpose();
  }
  return {log_sum(first), {first, (second.array().log() + most).matrix(), (third.array().log() + most).matrix()}};
}

}  // namespace

/// Of those of one amplitude, in their order.
SetFit SetEvidence::over_scalars(const Summands& scalars, const Products& products,
                                 const std::vector<Index>& columns) const {
  const Index r = products.gram.cols() - 1;
  SetFit fit{-0.5 * products.gram(r, r) - products.log_norm, std::vector<double>(scalars.size())};
  fit.densities.resize(scalars.size());
  if (scalars.empty()) return fit;
  std::vector<VectorXd> places;
  for (const Summand& s : scalars) places.push_back(all_places(amplitude_of(s), scalars.size() > 2));
  Summed found;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<VectorXd> alone;
    std::vector<Grid> grids;
    std::vector<std::vector<MatrixXd>> together(scalars.size(), std::vector<MatrixXd>(scalars.size()));
    for (std::size_t i = 0; i < scalars.size(); ++i) {
      grids.push_back(grid_of(scalars[i], columns, places[i]));
      const MatrixXd &mix = grids[i].mix, seen = mix * products.gram;
      alone.push_back(grids[i].log_weight + seen.col(r) - 0.5 * (seen.array() * mix.array()).rowwise().sum().matrix());
      for (std::size_t j = 0; j < i; ++j) together[j][i] = grids[j].mix * seen.transpose();
    }
    found = summed(alone, together);
    if (!std::isfinite(found.all)) break;
    const bool is_last = round > 0 && std::all_of(found.each.begin(), found.each.end(), is_resolved);
    for (std::size_t i = 0; i < scalars.size(); ++i) {
      Index best = 0;
      found.each[i].maxCoeff(&best);
      fit.amplitudes[i] = grids[i].sizes(best);
      fit.densities[i] = {grids[i].sizes, (found.each[i].array() - found.all).exp()};
      places[i] = where_it_counts(places[i], found.each[i]);
    }
    if (is_last) break;
  }
  fit.log_evidence += found.all;
  return fit;
}

/// What is told of one of several is the last of what over_scalars tells.
SetFit SetEvidence::over_vectors(const Members& vectors, std::size_t next, const Products& products,
                                 const Summands& scalars, const std::vector<Index>& columns,
                                 const OneOfSeveral* told) const {
  if (next == vectors.size()) return over_scalars(scalars, products, columns);
  std::vector<Index> own;
  std::vector<double> scales_of_own;
  Summands summed = scalars;
  const Summand kept{vectors[next], told ? told->number : 0};
  const bool keeps = told && told->candidate == vectors[next];
  if (keeps) summed.push_back(kept);
  const auto& amplitudes = problem_.candidates[vectors[next]].amplitudes;
  for (std::size_t k = 0; k < amplitudes.size(); ++k) {
    if (keeps && static_cast<Index>(k) == kept.number) continue;
    scales_of_own.push_back(scale_of(problem_.amplitudes[static_cast<std::size_t>(amplitudes[k])]));
    own.push_back(std::find(columns.begin(), columns.end(), amplitudes[k]) - columns.begin());
  }
  const Eigen::Map<const VectorXd> scales(scales_of_own.data(), std::ssize(scales_of_own));
  SetFit best{-infinite, std::vector<double>(scalars.size(), undefined), {scalars.size(), AmplitudeDensity{}}};
  VectorXd logs(multiples.size());
  for (std::size_t k = 0; k < multiples.size(); ++k) {
    const Taken taken =
        take_out(products.gram, products.gram(own, own), products.gram(own, Eigen::all), multiples[k] * scales);
    if (keeps) summed.back().deviation = multiples[k] * scale_of(amplitude_of(kept));
    SetFit fit =
        over_vectors(vectors, next + 1, {taken.gram, products.log_norm + taken.log_norm}, summed, columns, told);
    logs(static_cast<Index>(k)) = fit.log_evidence;
    if (fit.log_evidence > best.log_evidence) best = std::move(fit);
  }
  best.log_evidence = log_sum(logs) - std::log(static_cast<double>(multiples.size()));
  return best;
}

SetFit SetEvidence::over_all(const Members& members, std::size_t discrepancy, const OneOfSeveral* told) const {
  Summands scalars;
  Members vectors;
  for (const std::size_t c : members)
    if (is_scalar(c))
      scalars.push_back({c});
    else
      vectors.push_back(c);
  TETHER_ASSERT(scalars.size() + (told ? 1 : 0) <= 3, "{} amplitudes", scalars.size());
  const std::vector<Index> columns = columns_of(members);
  const Products& all = products_[discrepancy];
  return over_vectors(vectors, 0, {all.gram(columns, columns), all.log_norm}, scalars, columns, told);
}

AmplitudeDensity SetEvidence::density_of(const OneOfSeveral& told, const Members& members,
                                         std::size_t discrepancy) const {
  return over_all(members, discrepancy, &told).densities.back();
}

SetFit SetEvidence::fit(const Members& members, std::size_t discrepancy) const {
  SetFit fit = over_all(members, discrepancy, nullptr);
  SetFit of_members{fit.log_evidence, {}, {}};
  std::size_t next = 0;
  for (const std::size_t c : members) {
    const bool scalar = is_scalar(c);
    of_members.amplitudes.push_back(scalar ? fit.amplitudes[next] : undefined);
    of_members.densities.push_back(scalar ? std::move(fit.densities[next]) : AmplitudeDensity{});
    if (scalar) ++next;
  }
  return of_members;
}

double SetEvidence::log_evidence(const Members& members) const {
  VectorXd logs(discrepancies_.size());
  for (std::size_t s = 0; s < discrepancies_.size(); ++s)
    logs(static_cast<Index>(s)) = std::log(discrepancies_[s].prior) + fit(members, s).log_evidence;
  return log_sum(logs);
}

void SetEvidence::suppose(std::size_t candidate, double amplitude, double share) {
  const std::vector<Index> columns = columns_of({candidate});
  const VectorXd mix = share * mix_at({candidate}, amplitude, columns);
  for (Products& products : products_) {
    const Index data = products.gram.cols() - 1;
    const VectorXd seen = products.gram(Eigen::all, columns) * mix;
    products.gram.col(data).head(data) = seen.head(data);
    products.gram.row(data).head(data) = seen.head(data).transpose();
    products.gram(data, data) = mix.dot(seen(columns));
  }
}

double SetEvidence::signal(std::size_t discrepancy) const {
  return std::sqrt(products_[discrepancy].gram.bottomRightCorner<1, 1>().value());
}

double SetEvidence::beyond_runs(std::size_t candidate, double amplitude, bool coarse) const {
  double least = infinite;
  for (const AmplitudeCurve& side : curves_[candidate])
    for (const AmplitudeCurve::Point& point : side.points())
      if (point.size * amplitude > 0 && (coarse || !point.is_coarse))
        least = std::min(least, std::exp(std::abs(std::log(amplitude / point.size))));
  return least;
}

bool SetEvidence::is_beyond_all(std::size_t candidate, double amplitude) const {
  for (const AmplitudeCurve& side : curves_[candidate])
    for (const AmplitudeCurve::Point& point : side.points())
      if (point.size / amplitude > 1) return false;
  return true;
}

double SetEvidence::cosine(std::size_t a, std::size_t b) const {
  const MatrixXd& gram = products_.front().gram;
  const auto response = [&](std::size_t c) -> VectorXd {
    const auto& own = problem_.candidates[c].amplitudes;
    const VectorXd seen = gram(own, gram.cols() - 1);
    return MatrixXd(gram(own, own)).completeOrthogonalDecomposition().solve(seen);  // what fits best
  };
  const auto &of_a = problem_.candidates[a].amplitudes, &of_b = problem_.candidates[b].amplitudes;
  const VectorXd x = response(a), y = response(b);
  const double xx = x.dot(gram(of_a, of_a) * x), yy = y.dot(gram(of_b, of_b) * y), xy = x.dot(gram(of_a, of_b) * y);
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

}  // namespace tether
