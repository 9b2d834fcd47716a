/// The evidence for sets of candidates against what it is by definition.
#include "diagnosis/evidence/set_evidence.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "diagnosis/search/posterior.hpp"

namespace tether {
namespace set_evidence_test {

using Index = Eigen::Index;

constexpr Index data = 40;

void add_candidate(EffectProblem& problem, const std::string& name, const MatrixXd& changes, bool one_sided) {
  Candidate candidate{name, "", name, Candidate::Kind::effect, {}};
  for (Index k = 0; k < changes.cols(); ++k) {
    candidate.amplitudes.push_back(problem.changes.cols());
    problem.changes.conservativeResize(data, problem.changes.cols() + 1);
    problem.changes.rightCols(1) = changes.col(k);
    problem.amplitudes.push_back({name, name, "1", one_sided, 2.0, 0, false});
  }
  problem.candidates.push_back(candidate);
}

/// Independent data, an allowed error, a pattern; candidates "one", "other" (of either sign) and a vector of two.
EffectProblem problem(unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto random = [&](Index columns) {
    return MatrixXd::NullaryExpr(data, columns, [&] { return normal(generator); });
  };
  EffectProblem made;
  made.residual = random(1);
  made.precision = made.independent = VectorXd::Ones(data);
  for (Index i = 0; i < data; ++i) (i % 4 == 3 ? made.held_out : made.training).push_back(i);
  made.changes.resize(data, 0);
  made.allowed = random(1);
  made.allowed_deviation = VectorXd::Constant(1, 0.7);
  made.patterns = random(2);
  made.pattern_deviation = VectorXd::Constant(2, 0.5);
  made.pattern_names.resize(2);
  add_candidate(made, "one", 0.5 * random(1), true);
  add_candidate(made, "other", 0.5 * random(1), false);
  add_candidate(made, "vector", 0.5 * random(2), false);
  made.residual += 1.5 * made.changes.col(0);
  return made;
}

/// log of the normal density of x with this covariance, less the part that never changes.
double log_density(const VectorXd& x, const MatrixXd& covariance) {
  const Eigen::LLT<MatrixXd> factor(covariance);
  const VectorXd white = factor.matrixL().solve(x);
  return -0.5 * white.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
}

MatrixXd errors(const EffectProblem& p, double discrepancy) {
  return MatrixXd::Identity(data, data) + std::pow(0.7, 2) * p.allowed * p.allowed.transpose() +
         std::pow(0.5 * discrepancy, 2) * p.patterns * p.patterns.transpose();
}

double half_cauchy(double a, double scale) {
  return 2 / (std::numbers::pi * scale * (1 + std::pow(a / scale, 2)));
}

TEST(SetEvidence, OfNothingIsTheDensityOfTheData) {
  const EffectProblem p = problem(1);
  const SetEvidence evidence(p, {});
  for (const std::size_t s : {0, 4, 9})
    EXPECT_NEAR(evidence.fit({}, s).log_evidence, log_density(p.residual, errors(p, evidence.discrepancies()[s].size)),
                1e-9);
}

TEST(SetEvidence, IntegratesOverAnAmplitude) {
  const EffectProblem p = problem(2);
  const SetEvidence evidence(p, {});
  const MatrixXd covariance = errors(p, evidence.discrepancies()[2].size);
  double sum = 0;
  constexpr double step = 1e-3;
  for (double a = step / 2; a < 20; a += step)
    sum += step * half_cauchy(a, 2) * std::exp(log_density(p.residual - a * p.changes.col(0), covariance));
  EXPECT_NEAR(evidence.fit({0}, 2).log_evidence, std::log(sum), 0.03);
}

TEST(SetEvidence, IntegratesOverPairs) {
  const EffectProblem p = problem(3);
  const SetEvidence evidence(p, {});
  const MatrixXd covariance = errors(p, evidence.discrepancies()[1].size);
  double sum = 0;
  constexpr double step = 0.02;
  for (double a = step / 2; a < 8; a += step)
    for (double b = -6 + step / 2; b < 6; b += step)
      sum += step * step * half_cauchy(a, 2) * half_cauchy(b, 2) / 2 *
             std::exp(log_density(p.residual - a * p.changes.col(0) - b * p.changes.col(1), covariance));
  EXPECT_NEAR(evidence.fit({0, 1}, 1).log_evidence, std::log(sum), 0.05);
}

TEST(SetEvidence, OfAVectorIsThatOfWiderErrors) {
  const EffectProblem p = problem(4);
  const SetEvidence evidence(p, {});
  const MatrixXd covariance = errors(p, evidence.discrepancies()[0].size), changes = p.changes.rightCols(2);
  double sum = 0;
  for (const double multiple : {0.3, 1.0, 3.0, 10.0})
    sum +=
        std::exp(log_density(p.residual, covariance + std::pow(2 * multiple, 2) * changes * changes.transpose())) / 4;
  EXPECT_NEAR(evidence.fit({2}, 0).log_evidence, std::log(sum), 1e-9);
}

/// However well the data know it: a thousandth of itself, where places are a fifth of it apart at first.
TEST(SetEvidence, TellsAnAmplitudeAsSharplyAsTheDataDo) {
  EffectProblem p = problem(7);
  p.changes.col(1) *= 500;
  p.residual += 4 * p.changes.col(1);
  const SetEvidence evidence(p, {});
  const MatrixXd precision = errors(p, evidence.discrepancies()[0].size).inverse();
  const VectorXd change = p.changes.col(1);
  const double deviation = 1 / std::sqrt(change.dot(precision * change)),
               mean = std::pow(deviation, 2) * change.dot(precision * p.residual);
  ASSERT_LT(deviation, 4e-3);
  const AmplitudeDensity found = evidence.fit({1}, 0).densities[0];
  const double middle = found.probabilities.dot(found.sizes),
               variance = found.probabilities.dot((found.sizes.array() - middle).square().matrix());
  EXPECT_NEAR(middle, mean, 0.2 * deviation);
  EXPECT_NEAR(std::sqrt(variance), deviation, 0.1 * deviation);
}

/// The normal posterior of linear regression, with the multiple of its scale that is most probable.
TEST(SetEvidence, TellsTheAmplitudesOfAVector) {
  EffectProblem p = problem(6);
  p.residual += 4 * p.changes.col(2) - 3 * p.changes.col(3);
  const SetEvidence evidence(p, {});
  const MatrixXd precision = errors(p, evidence.discrepancies()[1].size).inverse(), changes = p.changes.rightCols(2);
  constexpr double multiple = 3;  // of the scale of 2
  const MatrixXd covariance =
      MatrixXd(changes.transpose() * precision * changes + std::pow(2 * multiple, -2) * MatrixXd::Identity(2, 2))
          .inverse();
  const VectorXd mean = covariance * (changes.transpose() * (precision * p.residual));
  for (const Index number : {0, 1}) {
    const AmplitudeDensity found = evidence.density_of({2, number}, {2}, 1);
    const double middle = found.probabilities.dot(found.sizes),
                 variance = found.probabilities.dot((found.sizes.array() - middle).square().matrix());
    const double deviation = std::sqrt(covariance(number, number));
    EXPECT_NEAR(found.probabilities.sum(), 1, 1e-9);
    EXPECT_NEAR(middle, mean(number), 0.2 * deviation) << "14 places";
    EXPECT_NEAR(std::sqrt(variance), deviation, 0.1 * deviation);
  }
}

/// A number that may not be otherwise explains nothing, beside a vector either.
TEST(SetEvidence, OfWhatCannotBeIsNone) {
  EffectProblem p = problem(9);
  p.amplitudes[0].lower = p.amplitudes[0].upper = p.amplitudes[0].base;
  const SetEvidence evidence(p, {});
  for (const std::vector<std::size_t>& members : {std::vector<std::size_t>{0}, {0, 1}, {0, 2}, {0, 1, 2}}) {
    const SetFit fit = evidence.fit(members, 0);
    EXPECT_EQ(fit.log_evidence, -infinite);
    EXPECT_EQ(fit.amplitudes.size(), members.size());
  }
}

/// What saturates is not weighed by its first order.
TEST(SetEvidence, FollowsWhatRunsShowed) {
  EffectProblem p = problem(5);
  const auto change = [&](double a) -> VectorXd { return 30 * (a / (1 + a / 2)) * p.changes.col(0); };
  const VectorXd noise = p.residual - 1.5 * p.changes.col(0);
  p.residual = noise + change(6);
  std::vector<ShownRun> runs;
  for (const double a : {2.0, 4.0, 5.0, 7.0, 10.0}) {
    VectorXd amplitudes = VectorXd::Zero(p.changes.cols());
    amplitudes(0) = a;
    runs.push_back({amplitudes, p.residual - change(a)});
  }
  const SetEvidence evidence(p, runs);
  EXPECT_NEAR(evidence.fit({0}, 0).amplitudes[0], 6, 0.3);
  EXPECT_NEAR(evidence.beyond_runs(0, 6, true), 7.0 / 6, 1e-9);
  EXPECT_TRUE(std::isinf(evidence.beyond_runs(1, 6, true)));
}

/// What two numbers do in the model itself is not what a coarser one says: that of the difference, as much as a finer
/// model may change still, is an error that data may have where the numbers do something.
class SetEvidenceOfTwoModels : public ::testing::Test {
 protected:
  SetEvidenceOfTwoModels() {
    p.left_by_refinement = 0.6;
    p.residual +=
        3 * p.changes.col(0) + 2 * p.changes.col(1) - 4 * VectorXd::Unit(data, 9) + 4 * VectorXd::Unit(data, 17);
    for (const Index c : {0, 1}) {
      p.amplitudes[static_cast<std::size_t>(c)].step = 1;
      p.amplitudes[static_cast<std::size_t>(c)].is_coarse = true;
      own.push_back(p.changes.col(c) + 0.8 * VectorXd::Unit(data, 5 + c) - 0.9 * VectorXd::Unit(data, 9));
      VectorXd amplitudes = VectorXd::Zero(p.changes.cols());
      amplitudes(c) = largest;
      runs.push_back({amplitudes, p.residual - largest * own.back()});
    }
  }

  /// As the coarser model beyond the run of the model itself, and on the side that was not run.
  VectorXd does(Index c, double a) const {
    if (a < 0) return a * p.changes.col(c);
    const double within = std::min(a, largest), scaled = own[c].dot(p.changes.col(c)) / p.changes.col(c).squaredNorm();
    return within * own[c] + (a - within) * scaled * p.changes.col(c);
  }
  VectorXd error(Index c, double a) const {
    const VectorXd y = does(c, a), shown = largest * own[c], seen = precision * shown;
    return 0.6 * largest * (own[c] - p.changes.col(c)) * y.dot(seen) / shown.dot(seen);
  }

  static constexpr double largest = 3;
  EffectProblem p = problem(12);
  std::vector<VectorXd> own;
  std::vector<ShownRun> runs;
  MatrixXd precision = errors(p, 0.1).inverse();
};

TEST_F(SetEvidenceOfTwoModels, AllowsForWhatAFinerOneWouldChange) {
  const SetEvidence evidence(p, runs);
  ASSERT_EQ(evidence.discrepancies()[0].size, 0.1);
  const MatrixXd covariance = errors(p, evidence.discrepancies()[2].size);
  const double step = 0.05;
  double one = 0, both = 0;
  const auto likely = [&](const VectorXd& does, const VectorXd& error) {
    return std::exp(log_density(p.residual - does, covariance + error * error.transpose()));
  };
  for (double a = step / 2; a < 20; a += step) one += step * half_cauchy(a, 2) * likely(does(0, a), error(0, a));
  EXPECT_NEAR(evidence.fit({0}, 2).log_evidence, std::log(one), 0.02);
  const double wide = 0.2;
  for (double a = wide / 2; a < 12; a += wide)
    for (double b = -12 + wide / 2; b < 12; b += wide)
      both += wide * wide * half_cauchy(a, 2) * half_cauchy(b, 2) / 2 *
              likely(does(0, a) + does(1, b), error(0, a) + error(1, b));
  EXPECT_NEAR(evidence.fit({0, 1}, 2).log_evidence, std::log(both), 0.05);
}

/// A finer model says more than a coarser one, of both: "other", which was not run with it, errs as "one" does.
TEST_F(SetEvidenceOfTwoModels, TakesTheErrorThatAFinerModelShows) {
  const VectorXd finer = largest * own[0] + 3 * VectorXd::Unit(data, 17), shown = largest * own[0],
                 seen = precision * shown, shift = finer - shown;
  runs.push_back({runs[0].amplitudes, p.residual - finer, RunOf::finer});
  const SetEvidence evidence(p, runs);
  const MatrixXd covariance = errors(p, evidence.discrepancies()[2].size);
  const double deviation = std::pow(2, 1.5) / std::sqrt(3), step = 0.05, wide = 0.2;
  for (const Index c : {0, 1}) {
    const auto told = evidence.error_of(static_cast<std::size_t>(c), largest);
    ASSERT_TRUE(told);
    const VectorXd is = deviation * shift * does(c, largest).dot(seen) / shown.dot(seen);
    EXPECT_LT((*told - is).norm(), 1e-9 * is.norm());
  }
  const auto likely = [&](const VectorXd& does) {
    const VectorXd error = deviation * shift * does.dot(seen) / shown.dot(seen);
    return std::exp(log_density(p.residual - does, covariance + error * error.transpose()));
  };
  double one = 0, both = 0;
  for (double a = step / 2; a < 20; a += step) one += step * half_cauchy(a, 2) * likely(does(0, a));
  EXPECT_NEAR(evidence.fit({0}, 2).log_evidence, std::log(one), 0.02);
  for (double a = wide / 2; a < 12; a += wide)
    for (double b = -12 + wide / 2; b < 12; b += wide)
      both += wide * wide * half_cauchy(a, 2) * half_cauchy(b, 2) / 2 * likely(does(0, a) + does(1, b));
  EXPECT_NEAR(evidence.fit({0, 1}, 2).log_evidence, std::log(both), 0.05);
}

/// No run of the model itself with it was made: it errs as what moves the data alike.
TEST_F(SetEvidenceOfTwoModels, TakesAnErrorFromWhatMovesTheDataAlike) {
  p.changes.col(1) = 1.2 * p.changes.col(0) + 0.1 * VectorXd::Unit(data, 3);
  own[1] = p.changes.col(1);
  runs.pop_back();
  const SetEvidence evidence(p, runs);
  const MatrixXd covariance = errors(p, evidence.discrepancies()[2].size);
  const VectorXd shown = largest * own[0], seen = precision * shown;
  const double step = 0.05;
  double sum = 0;
  for (double a = -20 + step / 2; a < 20; a += step) {
    const VectorXd error = 0.6 * largest * (own[0] - p.changes.col(0)) * a * own[1].dot(seen) / shown.dot(seen);
    sum += step * half_cauchy(a, 2) / 2 *
           std::exp(log_density(p.residual - a * own[1], covariance + error * error.transpose()));
  }
  EXPECT_NEAR(evidence.fit({1}, 2).log_evidence, std::log(sum), 0.02);
}

/// A coarser model's spring is a fifth too weak throughout: one run of the model says so.
TEST(AmplitudeCurve, TakesItsFormFromACoarserModelAndItsSizeFromTheModel) {
  const auto seen = [](double a) -> VectorXd { return VectorXd::LinSpaced(5, 1, 2) * (a / (1 + a)); };
  MatrixXd columns(5, 4);
  AmplitudeCurve curve;
  for (int k = 0; k < 3; ++k) {
    const double size = std::pow(4.0, k);
    columns.col(k) = 0.8 * seen(size);
    curve.add({size, k, 1, true});
  }
  columns.col(3) = seen(4.2);
  curve.add({4.2, 3, 1, false});
  curve.settle(columns, VectorXd::Ones(5));
  for (const double size : {0.3, 1.0, 2.0, 4.2, 8.0, 16.0, 100.0}) {
    VectorXd sum = VectorXd::Zero(5);
    for (const AmplitudeCurve::Share& part : curve.at(size))
      sum += part.share * part.point->factor * columns.col(part.point->column);
    EXPECT_NEAR((sum - seen(size)).norm() / seen(size).norm(), 0, 0.02) << size;
  }
}

/// A coarser model that is off by something of its own: near the model's runs the curve is theirs.
TEST(AmplitudeCurve, KeepsToTheModelsOwnPatternAwayFromItsRuns) {
  const VectorXd own = VectorXd::LinSpaced(5, 1, 2), off = VectorXd::Unit(5, 3);
  const auto seen = [&](double a) -> VectorXd { return own * (a / (1 + a)); };
  MatrixXd columns(5, 6);
  AmplitudeCurve curve;
  for (int k = 0; k < 4; ++k) {
    const double size = std::pow(3.0, k);
    columns.col(k) = 0.8 * seen(size) + 0.3 * off;
    curve.add({size, k, 1, true});
  }
  for (const Index k : {4, 5}) {
    const double size = k == 4 ? 2.5 : 4;
    columns.col(k) = seen(size);
    curve.add({size, k, 1, false});
  }
  curve.settle(columns, VectorXd::Ones(5));
  for (const double size : {2.5, 3.0, 4.0, 6.0}) {
    VectorXd sum = VectorXd::Zero(5);
    for (const AmplitudeCurve::Share& part : curve.at(size))
      sum += part.share * part.point->factor * columns.col(part.point->column);
    EXPECT_NEAR((sum - seen(size)).norm() / seen(size).norm(), 0, 0.05) << size;
  }
}

/// Two runs say how an effect saturates; one that does not is told in proportion, also beyond them.
TEST(AmplitudeCurve, FollowsWhatSaturates) {
  for (const double half : {0.5, 4.0, 1e6}) {
    const auto does = [&](double a) { return a / (1 + a / half); };
    MatrixXd columns(5, 2);
    AmplitudeCurve curve;
    for (const Index k : {0, 1}) {
      const double size = k == 0 ? 1 : 5;
      columns.col(k) = does(size) * VectorXd::LinSpaced(5, 1, 2);
      curve.add({size, k});
    }
    curve.settle(columns, VectorXd::Ones(5));
    for (const double size : {0.2, 1.0, 2.0, 5.0, 40.0}) {
      double sum = 0;
      for (const AmplitudeCurve::Share& part : curve.at(size)) sum += part.share * columns(0, part.point->column);
      EXPECT_NEAR(sum / does(size), 1, 1e-6) << size << " of " << half;
    }
  }
}

/// Data that a candidate makes are as probable as if they had been measured: of one amplitude, and of several.
TEST(SetEvidence, SupposesWhatACandidateMakes) {
  EffectProblem p = problem(8);
  SetEvidence supposed(p, {});
  for (const auto& [candidate, column] : {std::pair<std::size_t, Index>{1, 1}, {2, 2}}) {
    p.residual = 0.6 * 3 * p.changes.col(column);
    const SetEvidence measured(p, {});
    supposed.suppose(candidate, 3, 0.6);
    EXPECT_NEAR(supposed.log_evidence({candidate}), measured.log_evidence({candidate}), 1e-9);
    EXPECT_NEAR(supposed.log_evidence({}), measured.log_evidence({}), 1e-9);
    const Eigen::LLT<MatrixXd> factor(errors(p, supposed.discrepancies()[1].size));
    EXPECT_NEAR(supposed.signal(1), factor.matrixL().solve(p.residual).norm(), 1e-9);
  }
}

/// Sources that are held out as a whole judge, and name nothing.
TEST(SetEvidence, DoesNotLookAtWhatIsSealed) {
  EffectProblem p = problem(6);
  p.sealed = p.held_out;
  const double before = SetEvidence(p, {}).fit({0}, 0).log_evidence;
  for (const Index i : p.sealed) p.residual(i) = 100;
  EXPECT_DOUBLE_EQ(SetEvidence(p, {}).fit({0}, 0).log_evidence, before);
}

/// What noise may make is more probable where there is more of it; a name is as sure as in the worst case.
TEST(Posterior, SaysWhatANameDependsOn) {
  EffectProblem p = problem(7);
  for (Amplitude& amplitude : p.amplitudes) amplitude.step = 1.5;  // of which runs tell
  const Posterior posterior = posterior_of(p, SetEvidence(p, {}), std::vector<bool>(3, false));
  Weighed all = weighed(p, SetEvidence(p, {}), posterior);
  ASSERT_FALSE(all.groups.empty());
  weigh_otherwise(all, p, {}, posterior);
  ASSERT_EQ(all.otherwise.size(), 6U);
  double less = 0, more = 0;
  for (const WeighedOtherwise& one : all.otherwise) {
    ASSERT_EQ(one.groups.size(), all.groups.size());
    if (one.what == Assumed::noise) (one.factor < 1 ? less : more) = one.nothing;
    for (std::size_t g = 0; g < one.groups.size(); ++g) EXPECT_GE(one.groups[g], all.groups[g].least);
  }
  EXPECT_LT(less, posterior.nothing);
  EXPECT_GT(more, posterior.nothing);
  for (const WeighedGroup& group : all.groups) EXPECT_LE(group.least, group.probability);
}

/// Of many that no data show each is as probable as beforehand, and so is any number of them.
TEST(Posterior, CountsWhatTheDataDoNotShow) {
  EffectProblem p = problem(3);
  p.candidates.clear();
  p.amplitudes.clear();
  p.changes.resize(data, 0);
  p.pattern_deviation *= 1e-6;
  p.residual.setZero();
  constexpr int many = 40;
  for (int k = 0; k < many; ++k)
    add_candidate(p, fmt::format("unseen_{}", k), 1e-9 * MatrixXd::Identity(data, data).col(k), false);
  const Posterior posterior = posterior_of(p, SetEvidence(p, {}), std::vector<bool>(many, false));
  const double odds = 0.5 / many;
  double outside = 0;
  for (const EffectSet& set : posterior.sets) outside += set.with_more;
  const double in_catalogue = 1 - outside;
  EXPECT_NEAR(posterior.nothing / in_catalogue, std::pow(1 + odds, -many), 0.01);
  for (const std::size_t c : {0, many - 1}) EXPECT_NEAR(posterior.of(c) / in_catalogue, odds / (1 + odds), 2e-3);
}

/// A group is in the combinations that are told with it, and beside these in what is not told.
TEST(Posterior, ItsTableAddsUp) {
  EffectProblem p = problem(3);
  p.residual += 3 * p.changes.col(0);
  constexpr int faint = 40;
  for (int k = 0; k < faint; ++k)
    add_candidate(p, fmt::format("faint_{}", k), 1e-9 * MatrixXd::Identity(data, data).col(k), false);
  const SetEvidence evidence(p, {});
  const Posterior posterior = posterior_of(p, evidence, std::vector<bool>(p.candidates.size(), false));
  const Weighed table = weighed(p, evidence, posterior);
  double sum = table.nothing + table.outside + table.others;
  for (const WeighedCombination& one : table.combinations) sum += one.probability;
  EXPECT_NEAR(sum, 1, 1e-12);
  ASSERT_GT(table.groups.size(), 10U);
  ASSERT_GT(table.groups[0].probability, 0.9);
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    double told = 0;
    for (const WeighedCombination& one : table.combinations)
      if (std::count(one.groups.begin(), one.groups.end(), static_cast<int>(g)) > 0) told += one.probability;
    EXPECT_GE(table.groups[g].probability, told - 1e-12) << g;
    EXPECT_LE(table.groups[g].probability, told + table.others + 1e-12) << g;
  }
}

/// Twelve do much the same and each of them leads; beside one of them and a second, a third is there that by itself
/// explains less than any of them.
TEST(Posterior, FindsAThirdBesideMuchThatLooksAlike) {
  EffectProblem p = problem(5);
  p.candidates.clear();
  p.amplitudes.clear();
  p.changes.resize(data, 0);
  const MatrixXd unit = MatrixXd::Identity(data, data);
  const auto does = [&](Index k) -> VectorXd { return unit.col(k) + unit.col(k + 1); };
  constexpr std::size_t alike = 12;
  for (std::size_t k = 0; k < alike; ++k)
    add_candidate(p, fmt::format("alike_{}", k), does(0) + 0.02 * static_cast<double>(k) * unit.col(8), false);
  add_candidate(p, "second", does(3), false);
  add_candidate(p, "third", does(6), false);
  p.pattern_deviation *= 1e-6;
  p.residual = 14 * p.changes.col(0) + 12 * does(3) + 9 * does(6);
  const Posterior posterior = posterior_of(p, SetEvidence(p, {}), std::vector<bool>(p.candidates.size(), false));
  EXPECT_GT(posterior.of(alike), 0.95);
  EXPECT_GT(posterior.of(alike + 1), 0.95);
  EXPECT_EQ(posterior.sets.front().members.size(), 3U);
}

/// Of data drawn from the prior itself, what is said with a probability is right as often.
TEST(Posterior, SaysHowOftenItIsRight) {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  double said = 0, right = 0;
  int sure = 0, sure_and_wrong = 0;
  constexpr int draws = 400;
  for (int draw = 0; draw < draws; ++draw) {
    EffectProblem p = problem(100 + static_cast<unsigned>(draw));
    p.candidates.pop_back();
    p.amplitudes.resize(2);
    p.changes.conservativeResize(data, 2);
    p.pattern_deviation *= 0.1;  // of which a tenth to all is as probable
    p.residual = VectorXd::NullaryExpr(data, [&] { return normal(generator); }) + 0.7 * normal(generator) * p.allowed;
    std::vector<bool> present;
    for (Index c = 0; c < 2; ++c) {
      const double odds = 0.5 / 2, size = 2 * std::tan(std::numbers::pi / 2 * uniform(generator));
      present.push_back(uniform(generator) < odds / (1 + odds));
      if (present.back())
        p.residual += std::min(size, 150.0) * (c == 1 && uniform(generator) < 0.5 ? -1 : 1) * p.changes.col(c);
    }
    const SetEvidence evidence(p, {});
    const Posterior posterior = posterior_of(p, evidence, {false, false});
    for (std::size_t c = 0; c < 2; ++c) {
      const double probability = posterior.of(c);
      said += probability;
      right += present[c] ? 1 : 0;
      if (probability > 0.9) ++sure, sure_and_wrong += present[c] ? 0 : 1;
    }
  }
  EXPECT_NEAR(said / right, 1, 0.15) << right << " of " << 2 * draws;
  EXPECT_GT(sure, 50);
  EXPECT_LE(sure_and_wrong, 0.1 * sure);
}

}  // namespace set_evidence_test
}  // namespace tether
