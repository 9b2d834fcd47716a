#include "diagnosis/evidence/set_evidence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "diagnosis/evidence/data_errors.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/evidence/set_integrand.hpp"

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

bool shows_alone(const ShownRun& run, Index amplitude) {
  return run.amplitudes(amplitude) != 0 && (run.amplitudes.array() != 0).count() == 1 && run.residual.allFinite();
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
  MatrixXd columns = columns_of_curves(runs, rows);
  append_columns(columns, problem.residual);
  multiply_out(MatrixXd(columns(rows, Eigen::all)), rows);
  settle_numerics();
}

/// What each number does to first order, then what each run of a candidate by itself showed, of which curves are made.
MatrixXd SetEvidence::columns_of_curves(const std::vector<ShownRun>& runs, const std::vector<Index>& rows) {
  MatrixXd columns = problem_.changes;
  VectorXd precision = VectorXd::Zero(problem_.precision.size());
  precision(rows) = problem_.precision(rows);
  for (std::size_t c = 0; c < problem_.candidates.size(); ++c) {
    if (!is_scalar(c)) continue;
    const Index own = problem_.candidates[c].amplitudes.front();
    curves_[c].resize(2);
    const auto add = [&](const AmplitudeCurve::Point& point) { curves_[c][point.size > 0 ? 0 : 1].add(point); };
    if (const Amplitude& amplitude = amplitude_of({c}); amplitude.step != 0)
      add({amplitude.step, own, amplitude.step, amplitude.is_coarse});
    for (const ShownRun& run : runs)
      if (run.of != RunOf::finer && shows_alone(run, own)) {
        add({run.amplitudes(own), columns.cols(), 1, run.of == RunOf::coarser});
        append_columns(columns, problem_.residual - run.residual);
      }
    for (AmplitudeCurve& side : curves_[c]) side.settle(columns, precision);
    std::optional<ShownNumerics> numerics = add_refined(c, runs, columns);
    if (!numerics) numerics = add_coarse(c, columns);
    if (!numerics) continue;
    numerics->data = columns.col(numerics->column);
    numerics_.push_back(std::move(*numerics));
  }
  return columns;
}

/// Errors that are allowed, the ordinary ones first, those that are patterns last.
SetEvidence::Errors SetEvidence::errors_on(const std::vector<Index>& rows) const {
  std::vector<Index> ordinary;
  for (Index k = 0; k < problem_.allowed.cols(); ++k)
    if (std::count(problem_.allowed_patterns.begin(), problem_.allowed_patterns.end(), k) == 0) ordinary.push_back(k);
  const auto count = static_cast<Index>(ordinary.size()), patterns = problem_.pattern_deviation.size();
  Errors errors{MatrixXd(static_cast<Index>(rows.size()), count + patterns), problem_.allowed_deviation(ordinary)};
  errors.columns << problem_.allowed(rows, ordinary), problem_.patterns(rows, Eigen::seqN(0, patterns));
  return errors;
}

/// Products of all columns on these rows [m x c], in M of each discrepancy.
void SetEvidence::multiply_out(MatrixXd columns, const std::vector<Index>& rows) {
  Errors errors = errors_on(rows);
  const VectorXd root = problem_.precision(rows).cwiseSqrt() / assumed_.noise;
  errors.columns = root.asDiagonal() * errors.columns;
  columns = root.asDiagonal() * columns;
  const MatrixXd among = errors.columns.transpose() * errors.columns, across = errors.columns.transpose() * columns,
                 gram = columns.transpose() * columns;
  VectorXd deviations(errors.columns.cols());
  for (Index k = 0; k < errors.given.size(); ++k)
    deviations(k) = std::isfinite(errors.given(k)) ? errors.given(k)
                    : among(k, k) > 0              ? anything / std::sqrt(among(k, k))
                                                   : 0;
  for (const DiscrepancySize& discrepancy : discrepancies_) {
    deviations.tail(problem_.pattern_deviation.size()) =
        assumed_.discrepancy * discrepancy.size * problem_.pattern_deviation;
    Taken taken = take_out(gram, among, across, deviations);
    products_.push_back({std::move(taken.gram), taken.log_norm});
  }
}

/// By a run of the finer model and one of the model itself, of the same size.
std::optional<SetEvidence::ShownNumerics> SetEvidence::add_refined(std::size_t candidate,
                                                                   const std::vector<ShownRun>& runs,
                                                                   MatrixXd& columns) const {
  constexpr double finer_by = 2, same = 1 + 1e-6;
  const Index own = problem_.candidates[candidate].amplitudes.front();
  for (const ShownRun& finer : runs) {
    if (finer.of != RunOf::finer || !shows_alone(finer, own)) continue;
    const double size = finer.amplitudes(own);
    for (const AmplitudeCurve& side : curves_[candidate])
      for (const AmplitudeCurve::Point& point : side.points()) {
        if (point.is_coarse || !(point.size / size > 1 / same) || !(point.size / size < same)) continue;
        const VectorXd changes = problem_.residual - finer.residual;
        append_columns(columns,
                       wrong_before_refinement(finer_by) * (changes - point.factor * columns.col(point.column)));
        return ShownNumerics{candidate, size, columns.cols() - 1, RunOf::finer};
      }
  }
  return std::nullopt;
}

std::optional<SetEvidence::ShownNumerics> SetEvidence::add_coarse(std::size_t candidate, MatrixXd& columns) const {
  const AmplitudeCurve* largest = nullptr;
  for (const AmplitudeCurve& side : curves_[candidate])
    if (side.differs_from_coarse() && (!largest || std::abs(side.largest()) > std::abs(largest->largest())))
      largest = &side;
  if (!largest) return std::nullopt;
  VectorXd difference = VectorXd::Zero(columns.rows());
  for (const AmplitudeCurve::Share& part : largest->from_coarse())
    difference += part.share * part.point->factor * columns.col(part.point->column);
  append_columns(columns, problem_.left_by_refinement * difference);
  return ShownNumerics{candidate, largest->largest(), columns.cols() - 1, RunOf::coarser};
}

/// Null of what does not err.
const SetEvidence::ShownNumerics* SetEvidence::numerics_of(std::size_t candidate) const {
  if (errs_as_.empty() || errs_as_[candidate] < 0) return nullptr;
  return &numerics_[static_cast<std::size_t>(errs_as_[candidate])];
}

/// Each candidate errs as that does that was run with two models and moves the data most alike. Where a finer model
/// was run a coarser one tells less: its mesh may be the model's own.
void SetEvidence::settle_numerics() {
  const auto is_of_finer = [](const ShownNumerics& one) { return one.told_by == RunOf::finer; };
  if (std::any_of(numerics_.begin(), numerics_.end(), is_of_finer))
    std::erase_if(numerics_, [&](const ShownNumerics& one) { return !is_of_finer(one); });
  const MatrixXd& gram = products_.front().gram;
  for (ShownNumerics& one : numerics_) {
    const std::vector<Index> columns = columns_of({one.candidate});
    const VectorXd mix = mix_at({one.candidate}, one.size, columns);
    one.seen = gram(Eigen::all, columns) * mix;
    one.square = mix.dot(one.seen(columns));
  }
  std::erase_if(numerics_, [](const ShownNumerics& one) { return !(one.square > 0); });
  errs_as_.assign(problem_.candidates.size(), -1);
  for (std::size_t c = 0; c < problem_.candidates.size(); ++c) {
    double most = -1;
    if (!is_scalar(c) || !problem_.candidates[c].takes_runs()) continue;
    for (std::size_t k = 0; k < numerics_.size(); ++k) {
      const std::size_t other = numerics_[k].candidate;
      const double alike = other == c ? 2 : std::pow(cosine(c, other), 2);
      if (alike > most) most = alike, errs_as_[c] = static_cast<int>(k);
    }
  }
}

std::optional<VectorXd> SetEvidence::error_of(std::size_t candidate, double size) const {
  const ShownNumerics* numerics = numerics_of(candidate);
  if (!numerics) return std::nullopt;
  const std::vector<Index> columns = columns_of({candidate});
  return mix_at({candidate}, size, columns).dot(numerics->seen(columns)) / numerics->square * numerics->data;
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
  for (const std::size_t c : members)
    if (const ShownNumerics* numerics = numerics_of(c)) columns.push_back(numerics->column);
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
  const Index count = places.size();
  Grid grid{VectorXd(count), VectorXd(count), MatrixXd(count, columns.size()), MatrixXd::Zero(count, columns.size())};
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
  if (const ShownNumerics* numerics = numerics_of(summand.candidate)) {
    const auto column = std::find(columns.begin(), columns.end(), numerics->column) - columns.begin();
    grid.error.col(column) = grid.mix * numerics->seen(columns) / numerics->square;
    grid.errs = true;
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

}  // namespace

SetIntegrand SetEvidence::integrand_of(const std::vector<Grid>& grids, const MatrixXd& gram) {
  const std::size_t n = grids.size();
  const Index r = gram.cols() - 1;
  const auto sums = [](const MatrixXd& a, const MatrixXd& b) -> VectorXd { return a.cwiseProduct(b).rowwise().sum(); };
  const auto none = std::vector<std::vector<MatrixXd>>(n, std::vector<MatrixXd>(n));
  SetIntegrand all{{{}, none}, {{}, none}, {{}, none}};
  const bool errs = std::any_of(grids.begin(), grids.end(), [](const Grid& grid) { return grid.errs; });
  for (std::size_t i = 0; i < n; ++i) {
    const Grid& grid = grids[i];
    const MatrixXd seen = grid.mix * gram;
    all.density.alone.push_back(grid.log_weight + seen.col(r) - 0.5 * sums(seen, grid.mix));
    for (std::size_t j = 0; j < i; ++j) all.density.pairs[j][i] = -grids[j].mix * seen.transpose();
    if (!errs) continue;
    const MatrixXd seen_error = grid.error * gram;
    all.along.alone.push_back(seen_error.col(r) - sums(seen_error, grid.mix));
    all.size.alone.push_back(sums(seen_error, grid.error));
    for (std::size_t j = 0; j < i; ++j) {
      all.along.pairs[j][i] = -grids[j].error * seen.transpose() - grids[j].mix * seen_error.transpose();
      all.size.pairs[j][i] = 2 * grids[j].error * seen_error.transpose();
    }
  }
  return all;
}

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
    std::vector<Grid> grids;
    for (std::size_t i = 0; i < scalars.size(); ++i) grids.push_back(grid_of(scalars[i], columns, places[i]));
    found = summed(integrand_of(grids, products.gram));
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

std::optional<double> SetEvidence::closest_run(std::size_t candidate, double amplitude) const {
  std::optional<double> closest;
  const auto apart = [&](double size) { return std::abs(std::log(amplitude / size)); };
  for (const AmplitudeCurve& side : curves_[candidate])
    for (const AmplitudeCurve::Point& point : side.points())
      if (!point.is_coarse && point.size / amplitude > 0 && (!closest || apart(point.size) < apart(*closest)))
        closest = point.size;
  return closest;
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
