// Noise that was put in is measured: errors drawn by the twin, on a tube.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/noise/noise_text.hpp"
#include "twin/noise.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double deviation = 0.3, length = 0.6;

/// A tube about the z axis, radius 1, length 4: 12 places around, 12 along.
struct Tube {
  Tube() : places(3, 144), normals(3, 144) {
    for (Index i = 0; i < 144; ++i) {
      const double angle = std::numbers::pi / 6 * static_cast<double>(i % 12);
      normals.col(i) = Vec3(std::cos(angle), std::sin(angle), 0);
      places.col(i) = normals.col(i) + Vec3(0, 0, 4.0 / 11 * static_cast<double>(i / 12));
    }
  }
  Points places, normals;
};

struct Drawn {
  CorrelationShape shape = CorrelationShape::exponential;
  double nugget = 0, correlation_time = 0;
  int frames = 8;
  double alike_over = length;
};

/// Errors in frames 0.1 apart, with an offset and a shift that are not small.
NoiseField noise_on(const Tube& tube, const Drawn& drawn, std::uint64_t seed) {
  NoiseField field{tube.places, offset_and_shift(tube.places, tube.normals), {}};
  VectorXd last;
  for (int k = 0; k < drawn.frames; ++k) {
    const Random random(seed, static_cast<std::uint64_t>(k));
    VectorXd error =
        std::sqrt(1 - drawn.nugget) * RandomField(drawn.alike_over, random, drawn.shape)(tube.places) +
        std::sqrt(drawn.nugget) * RandomField(0, Random(seed, 100 + static_cast<std::uint64_t>(k)))(tube.places);
    const double kept = k > 0 && drawn.correlation_time > 0 ? std::exp(-0.1 / drawn.correlation_time) : 0;
    if (k > 0) error = VectorXd(kept * last + std::sqrt(1 - kept * kept) * error);
    last = error;
    field.frames.push_back({deviation * error + field.free * Eigen::Vector4d(1, 2, -3, 4), MatrixXd(144, 0), 0.1 * k});
  }
  return field;
}

bool holds(const MeasuredNumber& number, double truth) {
  return number.lower <= truth && truth <= number.upper;
}

/// What draws of a noise show.
struct Seen {
  int draws = 0, deviations = 0, lengths = 0, nuggets = 0, right_shape = 0, wrong_shape = 0, remarks = 0,
      below_half = 0;
  double log_deviation = 0, log_length = 0;
};

Seen seen_of(const Drawn& drawn, const Noise& stated, int draws) {
  const Tube tube;
  Seen seen;
  for (int seed = 1; seed <= draws; ++seed) {
    const MeasuredNoise noise = measured_noise({noise_on(tube, drawn, static_cast<std::uint64_t>(seed))}, stated);
    const NoiseFit& fit = noise.fits[noise.fits[0].shape == drawn.shape ? 0 : 1];
    ++seen.draws;
    seen.deviations += holds(fit.deviation, deviation);
    seen.lengths += holds(fit.correlation_length, drawn.alike_over);
    seen.nuggets += holds(fit.nugget, std::max(drawn.nugget, 0.0));
    seen.log_deviation += std::log(fit.deviation.value / deviation) / draws;
    seen.log_length += std::log(fit.correlation_length.value / drawn.alike_over) / draws;
    (noise.fits[0].shape == drawn.shape ? seen.right_shape : seen.wrong_shape) += noise.shape_is_told;
    seen.remarks += noise.stated->contradicts;
    seen.below_half += noise.stated->p < 0.5;
  }
  return seen;
}

std::ostream& operator<<(std::ostream& to, const Seen& s) {
  return to << "of " << s.draws << ": deviation " << s.deviations << ", length " << s.lengths << ", nugget "
            << s.nuggets << ", shape right " << s.right_shape << " wrong " << s.wrong_shape << ", remarks " << s.remarks
            << ", p < 0.5 " << s.below_half << "; mean log of deviation " << s.log_deviation << ", of length "
            << s.log_length;
}

/// Of 50 intervals of 95 % fewer than 43 hold the truth in 0.3 % of all cases.
constexpr int draws = 50, least = 43;

void expect_right(const Seen& seen) {
  EXPECT_GE(seen.deviations, least) << seen;
  EXPECT_GE(seen.lengths, least) << seen;
  EXPECT_NEAR(seen.log_deviation, 0, 0.04) << seen;
  EXPECT_NEAR(seen.log_length, 0, 0.1) << seen;
  EXPECT_LE(seen.remarks, 4) << seen;      // of 1 %: more in 0.02 % of all cases
  EXPECT_LE(seen.wrong_shape, 7) << seen;  // of 5 %: more in 0.3 %
}

TEST(MeasuredNoise, OfAnExponentialShapeIsWhatWasPutIn) {
  const Seen seen = seen_of({.nugget = 0.15}, {deviation, length, 0}, draws);
  expect_right(seen);
  EXPECT_GE(seen.nuggets, least) << seen;
}

/// The nugget is at its limit, and what of it seems to be there lengthens the rest.
TEST(MeasuredNoise, WithoutANuggetIsHeldByItsIntervals) {
  const Seen seen = seen_of({}, {deviation, length, 0}, draws);
  EXPECT_GE(seen.deviations, least) << seen;
  EXPECT_GE(seen.lengths, least) << seen;
  EXPECT_LE(seen.remarks, 4) << seen;
}

TEST(MeasuredNoise, OfAGaussianShapeIsWhatWasPutIn) {
  const Seen seen = seen_of({CorrelationShape::gaussian, 0.15}, {deviation, length, 0}, draws);
  expect_right(seen);
  EXPECT_GE(seen.nuggets, least) << seen;
}

/// Places are 0.36 apart and more: hardly any two are alike.
TEST(MeasuredNoise, OfAShorterLengthThanPlacesTellIsNotContradicted) {
  constexpr double shorter = 0.16;
  const Seen seen = seen_of({.nugget = 0.15, .alike_over = shorter}, {deviation, shorter, 0}, draws);
  EXPECT_GE(seen.deviations, least) << seen;
  EXPECT_GE(seen.lengths, least) << seen;
  EXPECT_LE(seen.remarks, 4) << seen;
}

TEST(MeasuredNoise, OfAnotherKindThanStatedIsSaid) {
  for (const Noise& stated : {Noise{deviation / 1.5, length, 0}, Noise{deviation, 3 * length, 0}}) {
    const Seen seen = seen_of({.nugget = 0.15}, stated, 15);
    EXPECT_GE(seen.remarks, 13) << seen << " for " << stated.deviation << " " << stated.correlation_length;
  }
}

TEST(MeasuredNoise, LastsAsLongAsItDoes) {
  const Tube tube;
  int held = 0, held_none = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto lasting = measured_noise({noise_on(tube, {.correlation_time = 0.15, .frames = 6}, seed)}, {});
    const auto none = measured_noise({noise_on(tube, {.frames = 6}, seed)}, {});
    ASSERT_TRUE(lasting.correlation_time && none.correlation_time);
    EXPECT_FALSE(lasting.stated);
    held += holds(*lasting.correlation_time, 0.15);
    held_none += none.correlation_time->lower == 0;
  }
  EXPECT_GE(held, 16);  // of 95 %: all but 0.3 % of cases
  EXPECT_GE(held_none, 16);
}

/// Of six frames 0.1 apart, errors of 0.4 make as many independent ones as 1.9 would.
TEST(MeasuredNoise, OfAnotherTimeThanStatedIsSaid) {
  const Tube tube;
  int said_short = 0, said_long = 0, said_right = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const NoiseField lasting = noise_on(tube, {.correlation_time = 0.4, .frames = 6}, seed);
    const auto check = [](const NoiseField& field, double time) {
      return *measured_noise({field}, {deviation, length, time}).stated;
    };
    const NoiseCheck fades_at_once = check(lasting, 0);
    said_short += fades_at_once.time_contradicts;
    ASSERT_TRUE(fades_at_once.measured_time.has_value());
    said_long += check(noise_on(tube, {.frames = 6}, seed), 0.4).time_contradicts;
    said_right += check(lasting, 0.4).time_contradicts;
  }
  EXPECT_EQ(said_short, 20);
  EXPECT_EQ(said_long, 20);
  EXPECT_LE(said_right, 2);  // of 1 %: more in 0.1 % of all cases
}

/// Neighbouring frames have in common what lasts: what they differ by is not held against all that is stated.
TEST(MeasuredNoise, OfNeighbouringFramesHidesWhatLasts) {
  const Tube tube;
  const NoiseField lasting = noise_on(tube, {.correlation_time = 0.4, .frames = 10}, 3);
  const auto at_rest = [&](double stated_time) {
    SeenNoise seen{NoiseOrigin::rest, "mri", {}, {deviation, length, stated_time}, {lasting}};
    NoiseField& pairs = seen.fields.front();
    pairs.frames.clear();
    for (std::size_t k = 0; k + 1 < lasting.frames.size(); k += 2) {
      const NoiseFrame &one = lasting.frames[k], &next = lasting.frames[k + 1];
      pairs.frames.push_back({(next.values - one.values) / std::sqrt(2), one.shared, one.time});
      seen.apart.push_back(next.time - one.time);
    }
    return seen;
  };
  SeenNoise left{NoiseOrigin::residual, "mri", {}, {deviation, length, 0}, {lasting}};
  const std::vector<MeasuredNoise> both = measured_noise({at_rest(0), left}, "cm");
  EXPECT_FALSE(both[0].stated.has_value());
  EXPECT_TRUE(both[0].line.empty());
  ASSERT_TRUE(both[0].shown.has_value());
  EXPECT_NEAR(*both[0].shown, 1 - std::exp(-0.1 / 0.4), 0.08);
  EXPECT_TRUE(both[1].stated->time_contradicts);
  EXPECT_FALSE(both[1].stated->contradicts);

  const MeasuredNoise alone = measured_noise(at_rest(0), "cm"), as_stated = measured_noise(at_rest(0.4), "cm");
  EXPECT_LT(alone.stated->deviation_ratio.upper, 0.7) << "nothing says that errors last";
  EXPECT_TRUE(holds(as_stated.stated->deviation_ratio, 1));
  EXPECT_EQ(as_stated.stated->deviation, deviation);
  EXPECT_FALSE(as_stated.correlation_time.has_value());
}

/// What is the same in all frames has an amplitude of its own, and is no noise.
TEST(MeasuredNoise, LeavesOutWhatIsShared) {
  const Tube tube;
  NoiseField field = noise_on(tube, {}, 3), more = field;
  for (NoiseFrame& frame : more.frames) {
    frame.shared = tube.places.row(2).transpose().array().cos();
    frame.shared.conservativeResize(Eigen::NoChange, 2);
    frame.shared.col(1) = 2 * frame.shared.col(0);  // twice the same is once
    frame.values += 5 * frame.shared.col(0);
  }
  const MeasuredNoise bare = measured_noise({field}, {}), freed = measured_noise({more}, {});
  EXPECT_EQ(freed.independent, bare.independent - 1);
  EXPECT_NEAR(freed.fits[0].deviation.value, bare.fits[0].deviation.value, 0.1 * deviation);
}

/// What a motion does to distances is rough with the data's errors: columns of it would take these out.
TEST(MeasuredNoise, ColumnsThatAreRoughWithItAreAveraged) {
  const Tube tube;
  int raw = 0, smooth = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    NoiseField field = noise_on(tube, {}, seed), even = field;
    for (std::size_t k = 0; k < field.frames.size(); ++k) {
      const VectorXd error = RandomField(length, Random(seed, k), CorrelationShape::exponential)(tube.places);
      const Eigen::ArrayXd swells = (std::numbers::pi / 4 * tube.places.row(2).transpose().array()).cos();
      field.frames[k].shared = std::sin(0.3 * static_cast<double>(k + 1)) * (swells + 0.1 * error.array()).matrix();
      even.frames[k].shared = averaged(tube.places, field.frames[k].shared);
    }
    raw += measured_noise({field}, {deviation, length}).stated->p < 0.01;
    smooth += measured_noise({even}, {deviation, length}).stated->p < 0.01;
  }
  EXPECT_EQ(raw, 12);
  EXPECT_LE(smooth, 1);
}

TEST(MeasuredNoise, ItsCorrelationByDistanceIsThatOfTheFit) {
  const Tube tube;
  std::vector<NoiseField> fields{noise_on(tube, {.frames = 40}, 5)};
  const MeasuredNoise noise = measured_noise(fields, {});
  ASSERT_FALSE(noise.correlation.empty());
  for (const CorrelationBin& bin : noise.correlation) EXPECT_NEAR(bin.measured, bin.exponential, 0.1) << bin.distance;
}

}  // namespace
}  // namespace tether
