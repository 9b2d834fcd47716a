// The periodic state of Windkessels, against closed forms and against many beats of small steps.
#include "fluid/windkessels/periodic_beat.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/windkessels/beats.hpp"

namespace tether {
namespace {

constexpr Windkessel adult{0.06, 1.1, 1.3};

/// Constant flow for the first half of a beat, none in the second, between them a step of no length.
PeriodicFlow square_flow(double value, double period) {
  return {{0, period / 2, period / 2 * (1 + 1e-8), period}, {value, value, 0, 0}};
}

/// P rises toward R_d q with exp(-t/tau) and falls with it: both ends follow from P(0) = P(T).
TEST(PeriodicBeat, OfASquareFlowIsTheClosedForm) {
  constexpr double q = 100, T = 0.9;
  const PeriodicFlow fine = square_flow(q, T).refined({}, 200);
  const PeriodicBeat beat = periodic_beat({&adult, 1}, fine);
  const double tau = adult.distal * adult.compliance, half = std::exp(-T / 2 / tau);
  const double lowest = adult.distal * q * half * (1 - half) / (1 - half * half);
  EXPECT_NEAR(beat.stored(0, 0), lowest, 1e-7 * lowest);
  for (std::size_t i = 0; i < beat.times.size(); ++i) {
    const double t = beat.times[i];
    if (t > T / 2) continue;
    const double stored = adult.distal * q + (lowest - adult.distal * q) * std::exp(-t / tau);
    EXPECT_NEAR(beat.stored(0, static_cast<Eigen::Index>(i)), stored, 1e-7 * stored) << t;
    EXPECT_NEAR(beat.pressure[static_cast<Eigen::Index>(i)], stored + adult.proximal * q, 1e-7 * stored) << t;
  }
}

/// A Windkessel divided is the Windkessel: each part takes its share at every moment.
TEST(PeriodicBeat, OfAlikeOutletsIsThatOfOne) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  const std::vector<double> shares{0.15, 0.05, 0.1, 0.7};
  std::vector<Windkessel> parts;
  for (const double s : shares) parts.push_back({adult.proximal / s, adult.distal / s, adult.compliance * s});
  const PeriodicBeat one = periodic_beat({&adult, 1}, flow), all = periodic_beat(parts, flow);
  EXPECT_LT((all.pressure - one.pressure).cwiseAbs().maxCoeff(), 1e-10 * one.pressure.maxCoeff());
  for (Eigen::Index i = 0; i < 4; ++i)
    EXPECT_LT(
        (all.flow.row(i).transpose() - shares[static_cast<std::size_t>(i)] * one.inlet_flow).cwiseAbs().maxCoeff(),
        1e-8);
}

/// Of unlike outlets the flows sum to the inlet's, and the beat ends as it begins; a midpoint rule that goes through
/// the beats step by step comes to the same, at its own order.
TEST(PeriodicBeat, OfUnlikeOutletsIsWhereManyBeatsEnd) {
  const std::vector<Windkessel> unlike{{0.5, 6, 0.1}, {0.2, 9, 0.3}, {0.1, 1.6, 0.9}};
  const PeriodicFlow flow = testing::beat_of_a_heart();
  const PeriodicBeat beat = periodic_beat(unlike, flow);
  const Eigen::Index last = beat.stored.cols() - 1;
  EXPECT_LT((beat.stored.col(last) - beat.stored.col(0)).cwiseAbs().maxCoeff(), 1e-11 * beat.stored.maxCoeff());
  EXPECT_LT((beat.flow.colwise().sum().transpose() - beat.inlet_flow).cwiseAbs().maxCoeff(), 1e-10);
  const auto off = [&](int steps_a_row) {
    const double dt = 0.8 / 160 / steps_a_row;
    Eigen::Vector3d P = beat.stored.col(0);
    double worst = 0;
    for (int i = 0; i < 160 * steps_a_row; ++i) {
      const auto slope = [&](const Eigen::Vector3d& at, double time) {
        double known = flow.at(std::min(time, 0.8 - 1e-12)), sum = 0;
        for (int k = 0; k < 3; ++k) known += at[k] / unlike[k].proximal, sum += 1 / unlike[k].proximal;
        Eigen::Vector3d s;
        for (int k = 0; k < 3; ++k)
          s[k] = ((known / sum - at[k]) / unlike[k].proximal - at[k] / unlike[k].distal) / unlike[k].compliance;
        return s;
      };
      const Eigen::Vector3d half = P + 0.5 * dt * slope(P, i * dt);
      P += dt * slope(half, (i + 0.5) * dt);
      if ((i + 1) % steps_a_row == 0)
        worst = std::max(worst, (P - beat.stored.col((i + 1) / steps_a_row)).cwiseAbs().maxCoeff());
    }
    return worst;
  };
  const double coarse = off(4), fine = off(8);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
}

/// A vessel that stores hardly anything is one that stores nothing; before a reservoir without resistance between, its
/// compliance is the reservoir's.
TEST(PeriodicBeat, OfAVesselThatStores) {
  const std::vector<Windkessel> unlike{{0.5, 6, 0.1}, {0.2, 9, 0.3}, {0.1, 1.6, 0.9}};
  const PeriodicFlow flow = testing::beat_of_a_heart();
  const PeriodicBeat none = periodic_beat(unlike, flow), hardly = periodic_beat(unlike, flow, 1e-9);
  EXPECT_LT((hardly.stored - none.stored).cwiseAbs().maxCoeff(), 1e-6 * none.stored.maxCoeff());
  EXPECT_LT((hardly.pressure - none.pressure).cwiseAbs().maxCoeff(), 1e-4 * none.pressure.maxCoeff());

  const Windkessel near{1e-7, 1.1, 0.5}, whole{1e-7, 1.1, 1.3};
  const PeriodicBeat parted = periodic_beat({&near, 1}, flow, 0.8), joined = periodic_beat({&whole, 1}, flow);
  EXPECT_LT((parted.stored - joined.stored).cwiseAbs().maxCoeff(), 1e-5 * joined.stored.maxCoeff());
  const Eigen::RowVectorXd leaves = joined.stored.row(0) / 1.1, filling = joined.inlet_flow.transpose() - leaves;
  EXPECT_LT((parted.flow.row(0) - leaves - near.compliance / whole.compliance * filling).cwiseAbs().maxCoeff(),
            1e-3 * joined.inlet_flow.maxCoeff());
}

TEST(PeriodicBeat, DoesNotDependOnFurtherTimes) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  const std::vector<double> more{0.1234, 0.777};
  const PeriodicFlow fine = flow.refined(more, 700);
  const PeriodicBeat all = periodic_beat({&adult, 1}, flow), finer = periodic_beat({&adult, 1}, fine);
  EXPECT_NEAR(all.stored(0, 0), finer.stored(0, 0), 1e-10 * all.stored(0, 0));
  EXPECT_NEAR(flow.mean(), fine.mean(), 1e-10 * flow.mean());
  for (const double time : more)
    EXPECT_NE(std::find(fine.times.begin(), fine.times.end(), time), fine.times.end()) << time;
}

TEST(PeriodicFlow, IsClosedAtItsPeriod) {
  const PeriodicFlow open = PeriodicFlow::closed({0, 1, 2}, {3, 5, 4}, 3);
  EXPECT_EQ(open.times, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(open.values.back(), 3);
  EXPECT_NEAR(open.mean(), (4 + 4.5 + 3.5) / 3, 1e-12);
  EXPECT_NEAR(open.at(2.5), 3.5, 1e-12);
  EXPECT_NEAR(open.at(3.5), 4, 1e-12);
  EXPECT_NEAR(open.at(-0.5), 3.5, 1e-12);
  EXPECT_EQ(PeriodicFlow::closed({0, 1, 3}, {3, 5, 4}, 3).values.back(), 4);
}

}  // namespace
}  // namespace tether
