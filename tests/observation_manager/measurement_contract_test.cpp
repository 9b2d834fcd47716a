// What every registered kind of measurement keeps: a new one is tested by being registered.
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.hpp"
#include "observation_manager/measurements/registry.hpp"
#include "tests/observation_manager/measured_samples.hpp"

namespace tether::testing {
namespace {

class EveryKind : public ::testing::TestWithParam<const MeasurementKind*> {
 protected:
  const std::string& kind() const { return GetParam()->name; }
  /// A case with one source, in line 5. more: further fields of it.
  Observations load(const std::string& more = "", const std::string& noise = "") const {
    const std::string source = sample.write(folder, truth);
    const std::string errors =
        noise.empty() ? fmt::format("{{deviation: {}, correlation_length: 0.2}}", sample.deviation) : noise;
    const auto path =
        folder.file("case.yaml", "name: tube\nunits: cgs\ntime: {step: 1e-2, end: 0.8}\nobservations:\n" +
                                     fmt::format("  {}: {{mine: {}, noise: {}{}}}}}\n", kind(), source, errors, more));
    CaseFile file(path);
    ObservationsCase given;
    file.read("observations", given);
    file.finish();
    return load_observations(given, model, file);
  }
  std::string message(const std::string& more, const std::string& noise = "") const {
    std::string text = message_of([&] { load(more, noise); });
    const std::string path = folder.path().string() + "/";
    for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
    return text;
  }
  static double rms(const std::vector<Datum>& data) {
    double squares = 0, count = 0;
    for (const Datum& datum : data)
      if (datum.is_seen && datum.independent > 0) squares += datum.residual * datum.residual, ++count;
    return std::sqrt(squares / count);
  }

  TemporaryFolder folder;
  const SimpleRun truth{}, other{2};
  const LumenSurface model = SimpleRun::imaged();
  const KindSample sample = sample_of(kind());
};

TEST_P(EveryKind, SaysWhatItIs) {
  const Observations data = load();
  ASSERT_EQ(data.all().size(), 1U);
  const MeasurementFacts facts = data.all().front()->facts();
  EXPECT_EQ(&facts.kind, GetParam());
  EXPECT_EQ(facts.field(), "observations." + kind() + ".mine");
  EXPECT_EQ(facts.noise.deviation, sample.deviation);
  EXPECT_FALSE(facts.held_out);
  EXPECT_FALSE(GetParam()->meaning.empty());
  EXPECT_FALSE(GetParam()->formats.empty());
}

TEST_P(EveryKind, SeesNothingButNoiseInTheRunThatItWasMeasuredOf) {
  const Observations data = load();
  const Measurement& mine = *data.all().front();
  const FinishedMotion same = truth.finished(), off = other.finished();
  const std::vector<MeasuredPart> parts = mine.parts(same);
  ASSERT_FALSE(parts.empty());
  for (const MeasuredPart& part : parts) {
    const std::vector<Datum> found = mine.data(same, part), elsewhere = mine.data(off, part);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.size(), elsewhere.size());
    EXPECT_LT(rms(found), sample.deviation);
    EXPECT_GT(rms(elsewhere), 2 * sample.deviation);
    EXPECT_TRUE(part.time >= 0 && part.time <= 0.8) << part.time;
  }
}

TEST_P(EveryKind, ItsDataCountAndLieSomewhere) {
  const Observations data = load();
  const Measurement& mine = *data.all().front();
  for (const MeasuredPart& part : mine.parts(truth.finished())) {
    double count = 0;
    for (const Datum& datum : mine.data(truth.finished(), part)) {
      EXPECT_TRUE(std::isfinite(datum.independent) && datum.independent >= 0) << datum.independent;
      EXPECT_TRUE(std::isfinite(datum.residual));
      EXPECT_TRUE(datum.position.allFinite() && datum.normal.allFinite());
      EXPECT_FALSE(datum.held_out);
      EXPECT_EQ(datum.shares.isZero(), !GetParam()->fallible.in_place) << "what shows the wall says where";
      count += datum.independent;
    }
    EXPECT_GT(count, 0);
  }
}

TEST_P(EveryKind, ItsRowsAreThoseThatAFilterSees) {
  const Observations data = load();
  const Measurement& mine = *data.all().front();
  const CountedRows rows = mine.rows(model.points, 0);
  const std::size_t count = rows.series_of.size();
  ASSERT_GT(count, 0U);
  EXPECT_EQ(rows.group_of.size(), count);
  EXPECT_EQ(rows.region.size(), count);
  EXPECT_TRUE(rows.positions.cols() == 0 || rows.positions.cols() == static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_LT(rows.series_of[i], rows.series.size());
    ASSERT_LT(rows.group_of[i], rows.groups.size());
  }
  for (const CountedSeries& series : rows.series) {
    EXPECT_EQ(series.times.size(), sample_times.size());
    EXPECT_TRUE(series.precision > 0 && std::isfinite(series.precision)) << series.precision;
  }
  for (const double time : {0.1, 0.2, 0.5}) {
    const std::vector<SeenRow> seen = mine.see(truth.at(time, data.points()), time);
    ASSERT_EQ(seen.size(), count);
    double weight = 0;
    for (const SeenRow& row : seen) {
      weight += row.weight;
      EXPECT_TRUE(row.weight == 0 || std::abs(row.difference) < sample.deviation) << row.difference;
    }
    EXPECT_GT(weight, 0) << time;
  }
}

TEST_P(EveryKind, HeldOutDataAreNoneForAFilterAndMarkedForAJudge) {
  const Observations data = load(", held_out: " + sample.held_out);
  const Measurement& mine = *data.all().front();
  for (const CountedSeries& series : mine.rows(model.points, 0).series)
    EXPECT_LT(series.times.size(), sample_times.size());
  std::size_t held_out = 0;
  for (const MeasuredPart& part : mine.parts(truth.finished()))
    for (const Datum& datum : mine.data(truth.finished(), part)) held_out += datum.held_out ? 1 : 0;
  EXPECT_GT(held_out, 0U);
}

TEST_P(EveryKind, BadInputIsNamedWithItsLine) {
  const std::string place = "case.yaml:5: observations." + kind() + ".mine.";
  EXPECT_TRUE(message(", deviation: 3").starts_with(place + "deviation: unknown field")) << message(", deviation: 3");
  EXPECT_TRUE(message("", "{deviation: -1}").starts_with(place + "noise.deviation: -1"))
      << message("", "{deviation: -1}");
  EXPECT_NE(message("", "{deviation: 1e-25}").find("noise.deviation: 1e-25: must not be smaller than 1e-12"),
            std::string::npos)
      << message("", "{deviation: 1e-25}");
  EXPECT_TRUE(message(", time_shift: 30").starts_with("case.yaml:5: observations." + kind() + ".mine: its "))
      << message(", time_shift: 30");
}

TEST_P(EveryKind, ItsContentIsThatOfItsData) {
  const std::uint64_t one = load().content(), again = load().content();
  EXPECT_EQ(one, again);
  sample.write(folder, other);
  CaseFile file(folder / "case.yaml");
  ObservationsCase given;
  file.read("observations", given);
  EXPECT_NE(load_observations(given, model, file).content(), one);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, ::testing::ValuesIn(measurement_kinds().begin(), measurement_kinds().end()),
                         [](const auto& info) { return info.param->name; });

}  // namespace
}  // namespace tether::testing
