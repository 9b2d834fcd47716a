#include "identification_master/identification.hpp"

#include <gtest/gtest.h>

#include "tests/identification_master/breathing_tube.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether::testing {
namespace {

constexpr int frames = 10;
constexpr double deviation = 0.06, correlation = 0.5;

/// Two parameters, linear, with a wide prior.
IdentifiedParameters parameters_of_tube() {
  static const TemporaryFolder folder;
  const auto path = folder / "case.yaml";
  std::ofstream(path) << "name: tube\nunits: cgs\ntime: {step: 0.01, end: 0.8}\n";
  const CaseFile file(path);
  IdentificationCase given;
  for (const char* name : {"front", "rear"}) {
    ParameterCase parameter;
    parameter.of = {name};
    parameter.mean = 0.1;
    parameter.deviation = 0.2;
    given.parameters.emplace_back(name, parameter);
  }
  std::vector<protocol::ParameterInfo> announced;
  for (const char* name : {"front", "rear"})
    announced.push_back({name, "", "cm", "linear", 0.1, 0, -infinite, infinite, 1, 1});
  return {given, announced, file};
}

/// Ten surfaces of a true tube of its own mesh over a beat.
Observations surfaces(int around, int along, double front, double rear, int model_around, int model_along,
                      CorrelatedErrors* errors = nullptr) {
  std::vector<SurfaceFrame> list;
  for (int k = 0; k < frames; ++k) {
    const double time = BreathingTube::beat * k / frames;
    TriangleSurface surface = BreathingTube::measured(around, along, time, front, rear);
    if (errors != nullptr) {
      const VectorXd e = errors->draw();
      for (Eigen::Index i = 0; i < e.size(); ++i)
        surface.points.col(i).head<2>() *= 1 + e(i) / surface.points.col(i).head<2>().norm();
    }
    list.push_back({time, std::move(surface), {}});
  }
  const LumenSurface model = lumen(BreathingTube::at(model_around, model_along, 0, 0, 0));
  SourceSettings settings = settings_for(model);
  settings.period = BreathingTube::beat;
  settings.noise = {deviation, correlation, 0};
  Observations data;
  data.lumen.push_back(
      std::make_unique<SurfaceSeries>(settings, std::move(list), std::vector<bool>(frames, false), model));
  return data;
}

EstimateRecord identified(const Observations& data, int around, int along, double dt, bool every_step = true) {
  BreathingEnsemble ensemble(data, around, along);
  const IdentifiedParameters parameters = parameters_of_tube();
  DataPrecision precision(data, ensemble.lumen(), dt, {0, BreathingTube::beat});
  if (!every_step) precision.count_frames_whole();
  IdentificationPlan plan{.start = 0,
                          .dt = dt,
                          .steps = std::lround(BreathingTube::beat / dt),
                          .every_step = every_step,
                          .largest_shift = 1e9};
  Identification filter(plan, parameters, precision, data.traces, ensemble);
  while (!filter.is_done()) filter.advance();
  return filter.last();
}

VectorXd deviations(const EstimateRecord& estimate) {
  return estimate.covariance.diagonal().cwiseSqrt();
}

/// A frame shows a half tube as area/(2 pi l^2) independent places with the signal s(t_k): the deviation follows by
/// hand.
TEST(Identification, IsAsSureAsTheDataAllow) {
  const Observations data = surfaces(48, 40, 0.3, -0.1, 24, 20);
  const EstimateRecord found = identified(data, 24, 20, 0.01);
  double squares = 0;
  for (int k = 0; k < frames; ++k) squares += std::pow(BreathingTube::swing(BreathingTube::beat * k / frames), 2);
  const double area = 2 * std::numbers::pi * BreathingTube::radius * BreathingTube::length;
  const double information =
      squares * area / (2 * std::numbers::pi * correlation * correlation) / 4 / (deviation * deviation);
  for (const double now : deviations(found))
    EXPECT_NEAR(now * std::sqrt(information), 1, 0.1);  // rims; interpolation between frames
  EXPECT_NEAR(found.mean(0), 0.3, 0.01);
  EXPECT_NEAR(found.mean(1), -0.1, 0.01);
}

TEST(Identification, DoesNotDependOnTheTimeStep) {
  const Observations data = surfaces(48, 40, 0.3, -0.1, 24, 20);
  const VectorXd coarse = deviations(identified(data, 24, 20, 0.02)),
                 fine = deviations(identified(data, 24, 20, 0.0025));
  EXPECT_LT((coarse.cwiseQuotient(fine).array() - 1).abs().maxCoeff(), 0.05)
      << coarse.transpose() << " | " << fine.transpose();
}

TEST(Identification, DoesNotDependOnTheDensityOfTheMesh) {
  const VectorXd coarse = deviations(identified(surfaces(48, 40, 0.3, -0.1, 16, 14), 16, 14, 0.01)),
                 fine = deviations(identified(surfaces(48, 40, 0.3, -0.1, 64, 56), 64, 56, 0.01));
  EXPECT_LT((coarse.cwiseQuotient(fine).array() - 1).abs().maxCoeff(), 0.05)
      << coarse.transpose() << " | " << fine.transpose();
}

TEST(Identification, AtFramesOnlyIsAboutAsSure) {
  const Observations data = surfaces(48, 40, 0.3, -0.1, 24, 20);
  const EstimateRecord every = identified(data, 24, 20, 0.01), only = identified(data, 24, 20, 0.01, false);
  EXPECT_LT((deviations(only).cwiseQuotient(deviations(every)).array() - 1).abs().maxCoeff(), 0.12);
  EXPECT_NEAR(only.mean(0), 0.3, 0.01);
}

/// 60 data sets with correlated errors: the truth is in the 95 % interval in 57 of 60 on average; 0.5 % of all series
/// of 120 fall below 108.
TEST(Identification, ItsIntervalsHoldTheTruth) {
  CorrelatedErrors errors(BreathingTube::measured(48, 25, 0, 0, 0).points, deviation, correlation, 11);
  int inside = 0;
  VectorXd mean_error = VectorXd::Zero(2);
  for (int trial = 0; trial < 60; ++trial) {
    const Observations data = surfaces(48, 25, 0.3, -0.1, 16, 14, &errors);
    const EstimateRecord found = identified(data, 16, 14, 0.02);
    const VectorXd error = found.mean - Eigen::Vector2d(0.3, -0.1);
    inside += static_cast<int>((error.cwiseAbs().array() < 1.96 * deviations(found).array()).count());
    mean_error += error / 60;
  }
  EXPECT_GE(inside, 108);
  std::printf("inside the 95 %% interval: %d of 120; mean error %.2g, %.2g\n", inside, mean_error(0), mean_error(1));
}

TEST(Identification, LeavesOutlyingDataOut) {
  Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  Trace wrong{"gauge", "fluid.front", {0, 0.4}, {5, 5}, Curve({0, 0.4}, {5, 5}), {0.01, 0, 0}, 0};
  data.traces.push_back(wrong);
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.01, {0, BreathingTube::beat});
  IdentificationPlan plan{.start = 0, .dt = 0.01, .steps = 80, .reject_beyond = 4, .largest_shift = 1e9};
  Identification careful(plan, parameters, precision, data.traces, ensemble);
  plan.reject_beyond = 0;
  Identification credulous(plan, parameters, precision, data.traces, ensemble);
  while (!careful.is_done()) careful.advance();
  while (!credulous.is_done()) credulous.advance();
  EXPECT_NEAR(careful.last().mean(0), 0.3, 0.02);
  EXPECT_GT(credulous.last().mean(0), 0.5);
}

TEST(Identification, ResumesWhereItWas) {
  const Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.02, {0, BreathingTube::beat});
  const IdentificationPlan plan{.start = 0, .dt = 0.02, .steps = 40, .largest_shift = 2};
  Identification whole(plan, parameters, precision, data.traces, ensemble),
      second(plan, parameters, precision, data.traces, ensemble);
  for (int step = 0; step < 17; ++step) whole.advance();
  second.restore(whole.state());
  while (!whole.is_done()) whole.advance();
  while (!second.is_done()) second.advance();
  EXPECT_EQ(whole.last().mean, second.last().mean);
  EXPECT_EQ(whole.last().covariance, second.last().covariance);
  EXPECT_EQ(whole.state().records.size(), second.state().records.size());
}

}  // namespace
}  // namespace tether::testing
