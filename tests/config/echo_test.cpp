#include "common/config/echo.hpp"

#include "tests/config/case_text.hpp"

namespace tether {
namespace {

struct Sample {
  double density = 1.06;
  std::optional<double> period;
  int layers = 2;
  bool on = true;
  std::string label = "a \"b\"";
  std::filesystem::path file = "/x/y.csv";
  std::vector<double> angles{0.1, 1e-20};
  std::vector<std::string> masks{"spine", "no"};
  Named<Vec3> points{{"middle", {1, 2, 3}}};
  std::string kind = "warm";
  double heat = 4, chill = 5;
  void declare(Fields& f) {
    f.number("density", density, dimension::density, range::positive, "");
    f.number("period", period, dimension::time, range::positive, "");
    f.integer("layers", layers, {}, "");
    f.flag("on", on, "");
    f.text("label", label, "");
    f.path("file", file, "");
    f.numbers("angles", angles, {}, "");
    f.texts("masks", masks, "");
    f.points("points", points, dimension::length, "");
    f.choice("kind", kind, {{"warm", ""}, {"cold", ""}}, "");
    f.when("kind", kind, {"warm"}, [&] { f.number("heat", heat, dimension::none, range::any, ""); });
    f.when("kind", kind, {"cold"}, [&] { f.number("chill", chill, dimension::none, range::any, ""); });
  }
};

TEST(Echo, WritesWhatHoldsAndLeavesOutWhatIsAbsent) {
  Echo echo;
  Sample sample;
  echo.group("fluid", sample, {});
  EXPECT_EQ(echo.yaml(), R"(fluid:
  density: 1.06
  layers: 2
  on: true
  label: "a \"b\""
  file: "/x/y.csv"
  angles: [0.1, 1e-20]
  masks: ["spine", "no"]
  points:
    middle: [1, 2, 3]
  kind: "warm"
  heat: 4
)");
}

TEST(Echo, ReadBackGivesTheSameNumbers) {
  Sample sample;
  sample.density = 0.1 + 0.2;
  sample.masks = {"opposite"};
  sample.file = write_file("data.csv", "t\n");
  sample.period = 1.0 / 3.0;
  Echo echo;
  echo.group("fluid", sample, {});
  const auto path = write_file("case.yaml", valid_head + echo.yaml());
  CaseFile file(path);
  Sample again;
  file.read("fluid", again);
  file.finish();
  EXPECT_EQ(again.density, sample.density);
  EXPECT_EQ(again.period, sample.period);
  EXPECT_EQ(again.label, sample.label);
  EXPECT_EQ(again.angles, sample.angles);
  EXPECT_EQ(again.masks, sample.masks);
  EXPECT_EQ(echo_json("fluid", again), echo.json());
}

TEST(Echo, JsonHoldsTheSection) {
  EXPECT_EQ(echo_json("time", TimeCase{0.5, 1.0, 0.0}),
            "{\n  \"time\": {\n    \"step\": 0.5,\n    \"end\": 1.0,\n    \"start\": 0.0\n  }\n}");
}

}  // namespace
}  // namespace tether
