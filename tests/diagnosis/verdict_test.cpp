#include "diagnosis/comparison/verdict.hpp"

#include <gtest/gtest.h>

#include <random>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/comparison/comparison.hpp"
#include "tests/diagnosis/beating_tube.hpp"

namespace tether::testing {
namespace verdict_test {

const UnitSystem cgs = UnitSystem::cgs();
const std::vector<std::string> regions{"right", "left"};

/// A source of moments at 0.1, 0.2, ... with these mean distances in "right", and zero in "left".
SourceDiscrepancy source_of(const std::vector<double>& means, Noise noise = {0.03, 0.6, 0}) {
  SourceDiscrepancy source;
  source.name = "ct";
  source.noise = noise;
  source.regions = regions;
  for (std::size_t i = 0; i < means.size(); ++i) {
    Moment moment{0.1 * static_cast<double>(i + 1), 0, false, {}, {}};
    for (const int region : {-1, 0, 1}) {
      Group group{-1, region, {}, {}, 4};
      group.model.counts[0] = 100;
      group.model.mean = region == 0 ? means[i] : 0;
      group.model.rms = std::max(std::abs(group.model.mean), noise.deviation);
      moment.groups.push_back(group);
    }
    source.moments.push_back(moment);
  }
  return source;
}

std::vector<std::string> sentences(const SourceDiscrepancy& source) {
  return sentences_of(judge(source, false), source, false, cgs);
}

TEST(Verdict, NamesPlaceTimeAmountAndDirection) {
  EXPECT_EQ(sentences(source_of({0, 0.01, -0.12, -0.14, -0.10, 0, 0})),
            std::vector<std::string>{"ct: right, 0.3-0.5 s: the model lies 1.4 mm too far outward (9.3 sigma)"});
  EXPECT_EQ(sentences(source_of({0, 0, 0.2})),
            std::vector<std::string>{"ct: right, 0.3 s: the model lies 2 mm too far inward (13.3 sigma)"});
}

TEST(Verdict, TellsTheFirstFailureFromTheWorst) {
  const SourceDiscrepancy source = source_of({0, 0.1, 0, 0, -0.2, -0.15, 0});
  const Judgement verdict = judge(source, false);
  EXPECT_EQ(verdict.failures.size(), 2U);
  EXPECT_EQ(sentences(source),
            (std::vector<std::string>{"ct: right, 0.5-0.6 s: the model lies 2 mm too far outward (13.3 sigma)",
                                      "ct, first: right, 0.2 s: the model lies 1 mm too far inward (6.7 sigma)"}));
}

TEST(Verdict, NamesOtherRegionsToo) {
  SourceDiscrepancy source = source_of({0, 0.1, 0, 0});
  source.moments[3].groups[2].model.mean = -0.09;
  EXPECT_EQ(sentences(source),
            (std::vector<std::string>{"ct: right, 0.2 s: the model lies 1 mm too far inward (6.7 sigma)",
                                      "ct, also: left, 0.4 s: the model lies 0.9 mm too far outward (6.0 sigma)"}));
}

TEST(Verdict, AFailureThatTurnsAroundIsTwo) {
  EXPECT_EQ(judge(source_of({0.1, 0.1, -0.1, -0.1}), false).failures.size(), 2U);
}

TEST(Verdict, SeesDistancesBothWaysThatCancelInTheMean) {
  SourceDiscrepancy source = source_of({0, 0, 0});
  source.moments[1].groups[2].model.rms = 0.15;
  EXPECT_EQ(sentences(source),
            std::vector<std::string>{
                "ct: left, 0.2 s: the model is 1.5 mm off both ways (root mean square; 5.0 times the noise)"});
}

TEST(Verdict, SaysHowLargeAnOffsetWouldHaveBeenSeen) {
  const SourceDiscrepancy source = source_of({0, 0.01, 0, 0, 0});
  const Judgement verdict = judge(source, false);
  EXPECT_EQ(verdict.tests, 10);
  EXPECT_NEAR(verdict.limit, normal_quantile(1 - 0.05 / 40), 1e-12);
  ASSERT_EQ(verdict.visible.size(), 2U);
  EXPECT_NEAR(verdict.visible[0].second, (verdict.limit + 1.644854) * 0.03 / 2, 1e-6);
  EXPECT_EQ(sentences(source),
            std::vector<std::string>{"ct: in all 10 pairs of region and frame the model is within the noise; a "
                                     "region's offset of 0.7 to 0.7 mm in one frame would have been seen"});
}

/// Whichever source it is of, and if held-out frames alone show it.
TEST(Verdict, FirstTellsWhereTheModelFailsWorst) {
  Comparison comparison;
  comparison.units = cgs;
  comparison.sources = {source_of({0, 0.01, 0}), source_of({0, 0.15, 0}), source_of({0, -0.2, 0})};
  comparison.sources[0].name = "fits";
  comparison.sources[1].name = "fails";
  comparison.sources[2].name = "fails more, with larger noise";
  comparison.sources[2].noise.deviation = 0.06;
  EXPECT_EQ(first_look_of(comparison),
            std::vector<std::string>{"fails: right, 0.2 s: the model lies 1.5 mm too far inward (10.0 sigma)"});
  for (Moment& moment : comparison.sources[1].moments) moment.held_out = true;
  EXPECT_EQ(first_look_of(comparison),
            std::vector<std::string>{
                "fails, held-out frames: right, 0.2 s: the model lies 1.5 mm too far inward (10.0 sigma)"});
  comparison.sources.resize(1);
  ASSERT_EQ(first_look_of(comparison).size(), 1U);
  EXPECT_NE(first_look_of(comparison)[0].find("within the noise"), std::string::npos);
}

TEST(Verdict, WithoutNoiseCallsNothingSignificant) {
  EXPECT_EQ(sentences(source_of({0, 0.1}, {})),
            std::vector<std::string>{"ct: no noise is stated, so nothing can be called significant; farthest off: "
                                     "right, 0.2 s: the model lies 1 mm too far inward"});
}

TEST(Verdict, OfTheBeatingTubeHasTheSignOfItsShift) {
  const SourceDiscrepancy source =
      compare(beating_contours({0.01, 0.25, 0}, {0, 0}), regions, beating_run(1, Vec3(0.06, 0, 0)));
  const Judgement verdict = judge(source, false);
  ASSERT_EQ(verdict.failures.size(), 2U);
  for (const Failure& failure : verdict.failures) {
    EXPECT_TRUE(failure.shifted);
    EXPECT_EQ(failure.region == 0, failure.mean < 0) << "moved to the right: too far outward there";
    EXPECT_DOUBLE_EQ(failure.first, 0.25);
    EXPECT_DOUBLE_EQ(failure.last, 1);
  }
}

/// Measurements with the stated errors, exponentially correlated around the contour, of a model that is right.
TEST(Verdict, RarelyAlarmsWhereNothingIsWrong) {
  constexpr int trials = 200, samples = 64;
  constexpr double circumference = 2 * std::numbers::pi, correlation = 0.25;
  const double keep = std::exp(-circumference / samples / correlation);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int alarms = 0;
  for (int trial = 0; trial < trials; ++trial) {
    SourceDiscrepancy source = source_of(std::vector<double>(25, 0.0), {0.02, correlation, 0});
    for (Moment& moment : source.moments) {
      std::vector<Distances> halves(2);
      double error = normal(random);
      for (int i = 0; i < samples; ++i) {
        Sample sample;
        sample.distance = 0.02 * error;
        sample.weight = circumference / samples;
        halves[static_cast<std::size_t>(2 * i / samples)].add(sample);
        error = keep * error + std::sqrt(1 - keep * keep) * normal(random);
      }
      for (std::size_t r = 0; r < 2; ++r) {
        Group& group = moment.groups[r + 1];
        group.model = halves[r].statistics();
        group.effective = effective_number(group.model.extent, 1, correlation, group.model.used());
      }
    }
    alarms += judge(source, false).failures.empty() ? 0 : 1;
  }
  EXPECT_LE(alarms, trials / 10);
}

}  // namespace verdict_test
}  // namespace tether::testing
