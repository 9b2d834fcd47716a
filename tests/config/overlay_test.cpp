#include "common/config/overlay.hpp"

#include <limits>

#include "common/config/case_tree.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

class OverlayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"cases", "out/deep"}) fs::create_directories(test_folder() / folder);
    base = write_file("cases/case.yaml",
                      "name: tube\nunits: cgs\ntime: {step: 1e-3, end: 1}\nsolid:\n  support: {a: 1, b: 2}\n");
  }
  static std::string error(std::vector<Overlay::Value> values) {
    return input_error_of([&] { write_overlay(test_folder() / "x.yaml", {base, "x", "", values}); });
  }
  static inline fs::path base;
};

TEST_F(OverlayTest, IsReadAsItWasWritten) {
  const double third = 1.0 / 3.0, tiny = std::numeric_limits<double>::denorm_min(), large = 9.8e5 * (1 + 1e-15);
  const fs::path file = test_folder() / "out/deep/case.yaml";
  write_overlay(file, {base,
                       "tube_2",
                       "Tube: with \"spine\" # and more",
                       {{"solid.support.a", number_text(third)},
                        {"solid.support.b", ""},
                        {"solid.support.regions.spine.stiffness", number_text(large)},
                        {"solid.support.regions.spine.damping", number_text(tiny)},
                        {"solid.angles", "[0, 1.5]"},
                        {"observations.ct", "{unit: mm, noise: {deviation: 0.3 mm}}"},
                        {"time.end", "0.2 s"}}});
  EXPECT_TRUE(std::ifstream(file).peek() == 'b') << "base stands first";
  const YamlNode own = read_yaml(file), tree = read_case_tree(file);
  EXPECT_EQ(own.find("base")->text, "../../cases/case.yaml");
  EXPECT_EQ(tree.find("name")->text, "tube_2");
  EXPECT_EQ(tree.find("title")->text, "Tube: with \"spine\" # and more");
  EXPECT_EQ(tree.find("time")->find("step")->text, "1e-3");
  EXPECT_EQ(tree.find("time")->find("end")->text, "0.2 s");
  const YamlNode& support = *tree.find("solid")->find("support");
  EXPECT_EQ(std::stod(support.find("a")->text), third);
  EXPECT_EQ(support.find("b"), nullptr);
  const YamlNode& spine = *support.find("regions")->find("spine");
  EXPECT_EQ(std::stod(spine.find("stiffness")->text), large);
  EXPECT_EQ(std::strtod(spine.find("damping")->text.c_str(), nullptr), tiny);
  EXPECT_EQ(tree.find("solid")->find("angles")->items[1].text, "1.5");
  EXPECT_EQ(tree.find("observations")->find("ct")->find("noise")->find("deviation")->text, "0.3 mm");
}

TEST_F(OverlayTest, GivesItsValuesBackInTheirOrder) {
  const std::vector<Overlay::Value> values{
      {"solid.support.a", "0.25"},
      {"solid.support.b", ""},
      {"solid.effects.mine.normal", "-k*un"},
      {"identification.parameters.k.of", "[solid.effects.mine.k, solid.support.a]"},
      {"time.end", "0.2 s"}};
  const fs::path file = test_folder() / "values.yaml", copy = test_folder() / "copy.yaml";
  write_overlay(file, {base, "x", "a title", values});
  std::vector<Overlay::Value> read = values_of_overlay(file);
  write_overlay(copy, {base, "x", "a title", read});
  EXPECT_EQ(yaml_text(read_yaml(copy)), yaml_text(read_yaml(file)));
  ASSERT_EQ(read.size(), values.size());
  EXPECT_EQ(read[1].field, "solid.support.b");
  EXPECT_EQ(read[1].text, "");
  EXPECT_EQ(read[3].text, "[solid.effects.mine.k, solid.support.a]");
  set_value(read, {"solid.support.b", "3"});
  set_value(read, {"solid.support.c", "4"});
  EXPECT_EQ(read[1].text, "3");
  EXPECT_EQ(read.back().field, "solid.support.c");
}

TEST_F(OverlayTest, RefusesWhatCannotBeWritten) {
  EXPECT_EQ(error({{"a..b", "1"}}), "'a..b': a name is missing beside a dot");
  EXPECT_EQ(error({{"", "1"}}), "'': a name is missing beside a dot");
  EXPECT_EQ(error({{"a.b", "1"}, {"a.b", "2"}}), "a.b: is given twice, or lies within a field that is");
  EXPECT_EQ(error({{"a", ""}, {"a.b", "2"}}), "a.b: is given twice, or lies within a field that is");
  EXPECT_EQ(error({{"a.b", "2"}, {"a", "1"}}), "a: is given twice, or lies within a field that is");
  EXPECT_EQ(error({{"name", "y"}}), "name: is given twice, or lies within a field that is");
  EXPECT_EQ(error({{"a", "[1"}}).substr(0, 14), "'[1': not YAML");
  try {
    write_overlay(test_folder() / "none/x.yaml", {base, "x", "", {}});
    ADD_FAILURE() << "it was written";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("none/x.yaml: cannot be written: its folder is gone"), std::string::npos);
  }
}

}  // namespace
}  // namespace tether
