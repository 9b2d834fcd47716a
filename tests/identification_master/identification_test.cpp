#include "identification_master/identification.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/estimate_files.hpp"
#include "identification_master/identifiability.hpp"
#include "tests/identification_master/measured_tube.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether::testing {
namespace identification_test {

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

/// The tube is linear in its parameters, so what its data tell does not depend on where the particles are.
TEST(Identification, WithoutCorrectionsItKnowsWhatTheDataWouldTell) {
  Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  data.traces.push_back({"gauge", "fluid.front", {0, 0.4}, {0, 0}, Curve({0, 0.4}, {0, 0}), {0.1, 0, 0}, 0.8});
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.01, {0, BreathingTube::beat});
  IdentificationPlan plan{.start = 0, .dt = 0.01, .steps = 80, .largest_shift = 1e9};
  Identification correcting(plan, parameters, precision, data, ensemble);
  plan.corrects = false;
  Identification watching(plan, parameters, precision, data, ensemble);
  MatrixXd gramian = MatrixXd::Zero(2, 2);
  watching.report_sensitivities([&](const StepSensitivities& step) {
    const double swing = BreathingTube::swing(step.time);
    gramian += step.changes.transpose() * step.precision.asDiagonal() * step.changes;
    const auto gauge = step.changes.rows() - 1;
    EXPECT_NEAR(step.changes(gauge, 0), 0.2 * swing, 1e-12) << "the trace is swing * front, front's deviation 0.2";
    EXPECT_NEAR(step.changes(gauge, 1), 0, 1e-12);
    EXPECT_NEAR(step.changes.col(0).head(gauge).maxCoeff(), 0.2 * swing, 0.02) << "the front moves outward";
  });
  while (!correcting.is_done()) correcting.advance();
  while (!watching.is_done()) watching.advance();
  EXPECT_LT((watching.last().mean - parameters.prior_mean()).norm(), 1e-14);
  const MatrixXd apart = watching.state().theta.colwise() - parameters.prior_mean();
  EXPECT_LT(apart.cwiseAbs().maxCoeff(), 0.1 * 0.2) << "so near that the model's curvature is no sensitivity";
  EXPECT_LT((deviations(watching.last()).cwiseQuotient(deviations(correcting.last())).array() - 1).abs().maxCoeff(),
            0.02);
  const Identifiability what = identifiability(parameters.prior_variances().asDiagonal(), watching.last().covariance);
  EXPECT_LT((what.gramian - gramian).norm(), 1e-9 * gramian.norm());
}

/// Measured in two planes across the tube at ten times, frame 3 held out and far off; one point lies behind the wall,
/// one is not measured in one frame.
VelocitySeries planes(std::mt19937& random, double error) {
  std::normal_distribution<double> normal(0, error);
  Points points(3, 18);
  for (Eigen::Index i = 0; i < 18; ++i) points.col(i) << 0.2 * static_cast<double>(i % 9), 0.1, i < 9 ? 1 : 9;
  points(0, 8) = 2.5;
  std::vector<VelocityFrame> list;
  for (int k = 0; k < frames; ++k) {
    const double time = BreathingTube::beat * k / frames;
    const Points v = BreathingTube::velocity(points, time, 0.3, -0.1);
    VelocityFrame frame{time, k == 3, v.row(2)};
    for (double& value : frame.values.reshaped())
      value = std::isnan(value) ? 0 : value + normal(random) + (k == 3 ? 9 : 0);
    if (k == 5) frame.values(0, 2) = std::nan("");
    list.push_back(frame);
  }
  return {{"pc_mr", Vec3::UnitZ().transpose(), BreathingTube::beat, 0.005, {error, 0, 0}}, points, list};
}

/// The deviation follows by hand: of each point in the lumen (1 - share^2) widening(z) swing(t) per parameter.
TEST(Identification, VelocitiesTellAsMuchAsTheirNoiseAllows) {
  constexpr double error = 0.02;
  std::mt19937 random(7);
  int inside = 0;
  for (int trial = 0; trial < 30; ++trial) {
    Observations data;
    data.velocities.push_back(planes(random, error));
    const EstimateRecord found = identified(data, 12, 10, 0.01, false);
    MatrixXd information = MatrixXd::Zero(2, 2);
    for (int k = 0; k < frames; ++k)
      for (Eigen::Index i = 0; i < 18; ++i) {
        const Points x = data.velocities[0].points().col(i);
        const Eigen::Vector2d s(BreathingTube::velocity(x, BreathingTube::beat * k / frames, 1, 0)(2, 0),
                                BreathingTube::velocity(x, BreathingTube::beat * k / frames, 0, 1)(2, 0));
        if (s.allFinite() && k != 3 && !(k == 5 && i == 2)) information += s * s.transpose() / (error * error);
      }
    information.diagonal().array() += 1 / 0.04;
    const VectorXd expected = information.inverse().diagonal().cwiseSqrt();
    EXPECT_LT((deviations(found).cwiseQuotient(expected).array() - 1).abs().maxCoeff(), 1e-3);
    const VectorXd off = found.mean - Eigen::Vector2d(0.3, -0.1);
    inside += static_cast<int>((off.cwiseAbs().array() < 1.96 * deviations(found).array()).count());
  }
  EXPECT_GE(inside, 52) << "of 60; 0.5 % of all series fall below";
}

TEST(Identification, LeavesOutlyingDataOut) {
  Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  Trace wrong{"gauge", "fluid.front", {0, 0.4}, {5, 5}, Curve({0, 0.4}, {5, 5}), {0.01, 0, 0}, 0};
  data.traces.push_back(wrong);
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.01, {0, BreathingTube::beat});
  IdentificationPlan plan{.start = 0, .dt = 0.01, .steps = 80, .reject_beyond = 4, .largest_shift = 1e9};
  Identification careful(plan, parameters, precision, data, ensemble);
  plan.reject_beyond = 0;
  Identification credulous(plan, parameters, precision, data, ensemble);
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
  Identification whole(plan, parameters, precision, data, ensemble),
      second(plan, parameters, precision, data, ensemble);
  for (int step = 0; step < 17; ++step) whole.advance();
  second.restore(whole.state());
  while (!whole.is_done()) whole.advance();
  while (!second.is_done()) second.advance();
  EXPECT_EQ(whole.last().mean, second.last().mean);
  EXPECT_EQ(whole.last().covariance, second.last().covariance);
  EXPECT_EQ(whole.state().totals.data, second.state().totals.data);
}

/// The trace `fluid.front` of a tube whose front widens by 0.3.
Trace front_trace(std::vector<double> times, double error = 0.01) {
  std::vector<double> values;
  for (const double time : times) values.push_back(0.3 * BreathingTube::swing(time));
  const Curve curve(times, values);
  return {"gauge", "fluid.front", std::move(times), std::move(values), curve, {error, 0, 0}, 0, 0.005};
}

/// Of a run from data as they are.
IdentificationState state_after(const Observations& data, bool every_step, double reject_beyond = 0,
                                double largest_shift = 1e9) {
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  DataPrecision precision(data, ensemble.lumen(), 0.01, {0, BreathingTube::beat});
  if (!every_step) precision.count_frames_whole();
  const IdentificationPlan plan{.start = 0,
                                .dt = 0.01,
                                .steps = 80,
                                .every_step = every_step,
                                .reject_beyond = reject_beyond,
                                .largest_shift = largest_shift};
  Identification filter(plan, parameters, precision, data, ensemble);
  while (!filter.is_done()) filter.advance();
  return filter.state();
}

double counted(const Observations& data, bool every_step) {
  return state_after(data, every_step).totals.data;
}

TEST(Identification, HeldOutTracesAreAsIfTheyWereNotThere) {
  Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  const EstimateRecord without = state_after(data, true).last;
  Trace wrong = front_trace({0, 0.2, 0.4, 0.6}, 0);  // without noise: nobody asks
  wrong.held_out = true;
  for (double& value : wrong.values) value += 5;
  data.traces.push_back(wrong);
  const EstimateRecord with = state_after(data, true).last;
  EXPECT_LT((with.mean - without.mean).norm(), 1e-14);
  EXPECT_LT((with.covariance - without.covariance).norm(), 1e-14);
}

TEST(Identification, EachValueOfATraceCountsOnceInBothModes) {
  for (const bool every_step : {true, false}) {
    Observations data;
    data.traces.push_back(front_trace({0.2, 0.3, 0.4, 0.5, 0.6}));
    EXPECT_NEAR(counted(data, every_step), 5, 1e-9) << every_step;
    data.traces.front() = front_trace({0.4});
    EXPECT_NEAR(counted(data, every_step), 1, 1e-9) << every_step;
    const EstimateRecord found = state_after(data, every_step).last;
    EXPECT_NEAR(found.mean(0), 0.3, 2e-3);
    EXPECT_NEAR(found.covariance(0, 0), 1 / (1 / 0.04 + 1e4), 1e-8);  // swing(0.4) = 1
  }
}

/// Surfaces and trace keep their own weights: neither counts in steps of the other's frames.
TEST(Identification, AtFramesOnlyEachSeriesCountsInItsOwnSteps) {
  Observations surfaces_only = surfaces(24, 20, 0.3, -0.1, 24, 20), both = surfaces(24, 20, 0.3, -0.1, 24, 20), trace;
  trace.traces.push_back(front_trace({0.11, 0.13, 0.19, 0.24, 0.33, 0.42, 0.51, 0.6, 0.77}));
  both.traces = trace.traces;
  const double alone = counted(surfaces_only, false);
  EXPECT_NEAR(counted(both, false), alone + 9, 0.01 * alone);
  EXPECT_NEAR(counted(both, true), counted(surfaces_only, true) + 9, 0.01 * alone);
}

/// Errors of frames between which a step interpolates are averaged: what is expected of their squares says so.
TEST(Identification, ChiSquareIsAsExpectedWhenAllIsRight) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (const bool every_step : {true, false}) {
    double chi_square = 0, expected = 0;
    for (int trial = 0; trial < 40; ++trial) {
      Observations data;
      std::vector<double> times;
      for (int k = 1; k < 20; ++k) times.push_back(0.04 * k);
      Trace trace = front_trace(times, 0.05);
      for (double& value : trace.values) value += 0.05 * normal(random);
      trace.curve = Curve(trace.times, trace.values);
      data.traces.push_back(trace);
      const DataTotals totals = state_after(data, every_step).totals;
      chi_square += totals.chi_square;
      expected += totals.expected_chi_square;
    }
    EXPECT_NEAR(chi_square / expected, 1, 3 * std::sqrt(2.0 / (40 * 19))) << every_step;
  }
}

/// Alternating errors are opposite from value to value, constant ones alike.
TEST(Identification, AutocorrelationIsACorrelation) {
  for (const double sign : {-1.0, 1.0}) {
    Observations data;
    std::vector<double> times;
    for (int k = 1; k < 20; ++k) times.push_back(0.04 * k);
    Trace trace = front_trace(times, 10);  // so that the estimate does not follow
    for (std::size_t k = 0; k < times.size(); ++k) trace.values[k] = (k % 2 == 0 ? 1 : sign);
    trace.curve = Curve(trace.times, trace.values);
    data.traces.push_back(trace);
    const double found = state_after(data, false).innovations.autocorrelation();
    EXPECT_LE(std::abs(found), 1);
    EXPECT_NEAR(found, sign, 0.05);
  }
}

TEST(Identification, SaysWhichShareWasRejectedAndWhatWasUsed) {
  Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  Trace wrong = front_trace({0.1, 0.2, 0.3, 0.4});
  for (double& value : wrong.values) value = 5;
  wrong.curve = Curve(wrong.times, wrong.values);
  data.traces.push_back(wrong);
  const DataTotals frames = state_after(data, false, 4).totals;
  EXPECT_NEAR(frames.rejected, 4, 1e-9);

  Observations good;
  good.traces.push_back(front_trace({0.3, 0.4}, 1e-3));
  const DataTotals tempered = state_after(good, false, 0, 0.1).totals;
  EXPECT_GT(tempered.tempered_steps, 0);
  EXPECT_NEAR(tempered.data, 2, 1e-9);
  EXPECT_LT(tempered.used, 0.1);
}

TEST(Identification, MemoryForgetsNothingBeforeTheFirstData) {
  Observations data;
  data.traces.push_back(front_trace({0.7}));
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.01, {0, BreathingTube::beat});
  Identification filter({.start = 0, .dt = 0.01, .steps = 60, .memory_time = 0.1}, parameters, precision, data,
                        ensemble);
  while (!filter.is_done()) filter.advance();
  EXPECT_LT((deviations(filter.last()).array() - 0.2).abs().maxCoeff(), 1e-12);
}

IdentificationCheckpoint taken_up(const std::filesystem::path& output, std::uint64_t fingerprint) {
  return read_identification_checkpoint(output, fingerprint, {}, [](const IdentificationCheckpoint&) {});
}

/// Before the first data too, when there is no discrepancy yet.
TEST(IdentificationCheckpoint, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  Observations data;
  data.traces.push_back(front_trace({0.2, 0.4}));
  for (const bool with_data : {false, true}) {
    IdentificationState state = state_after(data, false);
    if (!with_data) state.last_mean = VectorXd();
    write_checkpoint(folder.path(), 7, {state, {{1, 2}, {3}}, {1.5, 2.5, 0.5, 3}, 11});
    const IdentificationCheckpoint found = taken_up(folder.path(), 7);
    EXPECT_EQ(found.state.step, state.step);
    EXPECT_EQ(found.state.theta, state.theta);
    EXPECT_EQ(found.state.last_mean, state.last_mean);
    EXPECT_EQ(found.state.last.mean, state.last.mean);
    EXPECT_EQ(found.state.last.expected_chi_square, state.last.expected_chi_square);
    EXPECT_EQ(found.state.totals.data, state.totals.data);
    EXPECT_EQ(found.state.totals.expected_chi_square, state.totals.expected_chi_square);
    EXPECT_EQ(found.table, 11u);
    EXPECT_EQ(found.state.innovations.squares_before, state.innovations.squares_before);
    EXPECT_EQ(found.at_hand, (std::vector<std::vector<double>>{{1, 2}, {3}}));
    EXPECT_EQ(found.cost.cpu_seconds, 2.5);
    EXPECT_EQ(found.cost.moved_values, 3);
    EXPECT_THROW(taken_up(folder.path(), 8), InputError);
  }
}

TEST(IdentificationCheckpoint, TheOneBeforeIsTakenIfTheNewestIsDamagedOrMissing) {
  const TemporaryFolder folder;
  Observations data;
  data.traces.push_back(front_trace({0.2, 0.4}));
  IdentificationState state = state_after(data, false);
  const auto step = state.step;
  write_checkpoint(folder.path(), 7, {state, {}, {}});
  ++state.step;
  write_checkpoint(folder.path(), 7, {state, {}, {}});
  EXPECT_EQ(taken_up(folder.path(), 7).state.step, step + 1);
  const auto newest = folder / "checkpoint/identification.bin";
  std::filesystem::resize_file(newest, std::filesystem::file_size(newest) - 1);
  EXPECT_EQ(taken_up(folder.path(), 7).state.step, step);
  EXPECT_NE(taken_up(folder.path(), 7).refused.find("identification.bin: is cut short"), std::string::npos);
  std::filesystem::remove(newest);
  EXPECT_EQ(taken_up(folder.path(), 7).state.step, step);
  write_checkpoint(folder.path(), 8, {state, {}, {}});
  EXPECT_THROW(taken_up(folder.path(), 7), InputError) << "that before is of this case, but old";
  std::filesystem::remove(newest);
  std::filesystem::resize_file(folder / "checkpoint/identification.previous", 9);
  EXPECT_THROW(taken_up(folder.path(), 7), InputError);
  write_checkpoint(folder.path(), 7, {state, {}, {}});
  std::filesystem::rename(newest, folder / "checkpoint/identification.new");
  EXPECT_EQ(taken_up(folder.path(), 7).state.step, step + 1) << "killed between the two renames";
  ++state.step;
  write_checkpoint(folder.path(), 7, {state, {}, {}});
  std::filesystem::resize_file(newest, 9);
  EXPECT_EQ(taken_up(folder.path(), 7).state.step, step + 1) << "it made no room for the next";
}

/// What a checkpoint counts on may be damaged while it is whole itself.
TEST(IdentificationCheckpoint, TheOneBeforeIsTakenIfTheNewestsTableIsDamaged) {
  const TemporaryFolder folder;
  Observations data;
  data.traces.push_back(front_trace({0.2, 0.4}));
  IdentificationState state = state_after(data, false);
  for (const std::uint64_t table : {1, 2}) {
    write_checkpoint(folder.path(), 7, {state, {}, {}, table});
    ++state.step;
  }
  const auto refusing = [&](std::uint64_t last_whole) {
    return read_identification_checkpoint(folder.path(), 7, {}, [&](const IdentificationCheckpoint& found) {
      if (found.table > last_whole) throw input_error("estimate.csv: has 3 rows, the checkpoint 9");
    });
  };
  EXPECT_EQ(refusing(2).table, 2u);
  EXPECT_EQ(refusing(1).table, 1u);
  EXPECT_EQ(refusing(1).refused, "estimate.csv: has 3 rows, the checkpoint 9");
  EXPECT_THROW(refusing(0), InputError);
}

/// Killed just before a checkpoint was put in its place, and begun anew with another case.
TEST(IdentificationCheckpoint, OfAnEarlierIdentificationNoneIsLeft) {
  const TemporaryFolder folder;
  Observations data;
  data.traces.push_back(front_trace({0.2, 0.4}));
  const IdentificationState state = state_after(data, false);
  const auto message = [&] { return message_of([&] { taken_up(folder.path(), 8); }); };
  for (int checkpoint = 0; checkpoint < 3; ++checkpoint) write_checkpoint(folder.path(), 7, {state, {}, {}});
  const std::filesystem::path saved = folder / "checkpoint", of_run = folder / "checkpoint.new";
  const auto name = [](const char* what) { return std::string("identification.") + what; };
  EXPECT_TRUE(message().starts_with((saved / name("bin")).string() + ": is a checkpoint of another case"));
  std::filesystem::rename(saved / name("bin"), saved / name("new"));
  EXPECT_TRUE(message().starts_with((saved / name("new")).string() + ": is a checkpoint of another case"))
      << "names the file that it is";
  std::filesystem::copy(saved, of_run);  // where a run lends them to
  remove_old_estimates(folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(saved) && std::filesystem::is_empty(of_run));
  EXPECT_NE(message().find("holds no checkpoint of an identification"), std::string::npos) << message();
  write_checkpoint(folder.path(), 8, {state, {}, {}});
  EXPECT_FALSE(std::filesystem::exists(saved / name("previous")));
}

TEST(Observations, TheirContentNamesWhatWasMeasured) {
  Observations data = surfaces(12, 10, 0.3, -0.1, 12, 10);
  data.traces.push_back(front_trace({0.2, 0.4}));
  const std::uint64_t content = data.content();
  Observations again = surfaces(12, 10, 0.3, -0.1, 24, 20);
  again.traces.push_back(front_trace({0.2, 0.4}));
  EXPECT_EQ(again.content(), content);
  again.traces.front().values[1] += 1e-9;
  EXPECT_NE(again.content(), content);
  Observations other = surfaces(12, 10, 0.3, -0.1001, 12, 10);
  other.traces = data.traces;
  EXPECT_NE(other.content(), content);
}

}  // namespace identification_test
}  // namespace tether::testing
