#include "common/config/case_tree.hpp"

#include "common/base/error.hpp"
#include "common/config/identified_parameters.hpp"
#include "common/config/output_folder.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace case_tree_test {

namespace fs = std::filesystem;

const EffectDeclaration warm{"warm",
                             "",
                             Place::wall,
                             {{"heat", "of it", dimension::none, range::positive, undefined, 0},
                              {"area", "of both", dimension::none, range::positive, 1, 0}}};
const EffectDeclaration cold{"cold",
                             "",
                             Place::wall,
                             {{"chill", "of it", dimension::none, range::any, 5, 0},
                              {"area", "of both", dimension::none, range::positive, 1, 0}}};
constexpr std::array<const EffectDeclaration*, 2> kinds{&warm, &cold};

struct Patch {
  EffectCase kind{"", {}};
  void declare(Fields& f) { f.effect(kind, kinds, "of patch"); }
};

struct Blood {
  double density = undefined;
  std::filesystem::path curve, table;
  std::vector<double> angles;
  Named<Patch> patches;
  void declare(Fields& f) {
    f.number("density", density, dimension::density, range::positive, "mass per volume");
    f.path("curve", curve, "over time");
    f.path("table", table, "of values");
    f.numbers("angles", angles, {0, dimension::none, range::any}, "some");
    f.groups("patches", patches, "by name");
  }
};

/// A base in a folder of its own with a file beside it; what builds on it stands in another.
class CaseTree : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"base", "over"}) fs::create_directories(test_folder() / folder);
    for (const char* file : {"base/flow.csv", "over/other.csv"}) write_file(file, "t\n");
    write_file("base/case.yaml",
               "name: tube\nunits: cgs\ntime: {step: 1e-3, end: 1}\nfluid:\n  density: 1.06\n"
               "  curve: flow.csv\n  angles: [1, 2, 3]\n  patches:\n"
               "    left: {type: warm, heat: 3, area: 7}\n    right: {type: cold, chill: -1}\n");
  }
  static Blood read(const fs::path& path) {
    CaseFile file(path);
    Blood blood;
    file.read("fluid", blood);
    file.finish();
    return blood;
  }
  static fs::path over(const std::string& text) { return write_file("over/case.yaml", head + text); }
  static std::string error(const std::string& text) {
    const fs::path path = over(text);
    return input_error_of([&] { read(path); });
  }
  static inline const std::string head = "base: ../base/case.yaml\nname: other\n";
};

TEST_F(CaseTree, MayRemoveWhatWasRemovedAndGiveItAnew) {
  over("fluid: {patches: {left: ~}}\n");
  const auto upon = [](const std::string& text) {
    return write_file("third.yaml", "base: over/case.yaml\nname: third\n" + text);
  };
  EXPECT_EQ(read(upon("fluid: {patches: {left: ~}}\n")).patches.size(), 1u);
  const Blood again = read(upon("fluid: {patches: {left: {type: warm, heat: 5}}}\n"));
  ASSERT_EQ(again.patches.size(), 2u);
  const YamlNode tree = read_case_tree(upon("fluid: {patches: {left: {type: warm, heat: 5}}}\n"));
  EXPECT_EQ(tree.find("fluid")->find("patches")->find("left")->find("area"), nullptr) << "nothing of what was removed";
}

TEST_F(CaseTree, MergesSectionsAndKeepsPathsWhereTheyStand) {
  const fs::path path = over(
      "time: {end: 2}\nfluid:\n  table: other.csv\n  angles: [9]\n  patches: {left: {heat: 4}, top: {type: cold}}\n");
  CaseFile file(path);
  EXPECT_EQ(file.common().name, "other");
  EXPECT_EQ(file.common().time.step, 1e-3);
  EXPECT_EQ(file.common().time.end, 2);
  const Blood blood = read(path);
  EXPECT_EQ(blood.density, 1.06);
  EXPECT_EQ(blood.curve, test_folder() / "base/flow.csv");
  EXPECT_EQ(blood.table, test_folder() / "over/other.csv");
  EXPECT_EQ(blood.angles, std::vector{9.0}) << "lists are replaced";
  ASSERT_EQ(blood.patches.size(), 3U);
  EXPECT_EQ(blood.patches[0].first, "left") << "the base's order, then what is new";
  EXPECT_EQ(blood.patches[0].second.kind.values, (std::vector{4.0, 7.0}));
  EXPECT_EQ(blood.patches[2].first, "top");
}

TEST_F(CaseTree, RemovesWhatHasNoValue) {
  const Blood blood = read(over("fluid: {curve: , patches: {left: ~}}\n"));
  EXPECT_TRUE(blood.curve.empty());
  ASSERT_EQ(blood.patches.size(), 1U);
  EXPECT_EQ(blood.patches[0].first, "right");
  EXPECT_EQ(error("fluid: {density: }\n"),
            "over/case.yaml:3: fluid.density: missing: must be given in g/cm3 (mass per volume)");
}

TEST_F(CaseTree, AnotherTypePassesOverWhatOnlyTheBasesTypeKnows) {
  const Blood blood = read(over("fluid: {patches: {left: {type: cold, chill: 2}}}\n"));
  EXPECT_EQ(blood.patches[0].second.kind.type, "cold");
  EXPECT_EQ(blood.patches[0].second.kind.values, (std::vector{2.0, 7.0})) << "the area is known to both";
  EXPECT_EQ(error("fluid: {patches: {right: {type: warm}}}\n"),
            "over/case.yaml:3: fluid.patches.right.heat: missing: must be given (of it)");
  EXPECT_EQ(error("fluid: {patches: {right: {heat: 2}}}\n"),
            "over/case.yaml:3: fluid.patches.right.heat: only with 'type: warm'; here type is 'cold'")
      << "what this file says itself is not passed over";
}

TEST_F(CaseTree, MessagesNameTheFileInWhichAMistakeStands) {
  write_file("base/case.yaml",
             "name: tube\nunits: cgs\ntime: {step: 1e-3, end: 1}\nfluid:\n  density: -1\n"
             "  curve: none.csv\n  anglse: [1]\nflud: {}\n");
  EXPECT_EQ(error("fluid:\n  desity: 2\n  angles: x\n"),
            "over/case.yaml:4: fluid.desity: unknown field; did you mean 'density'?\n"
            "over/case.yaml:5: fluid.angles: a single value: must be a list of numbers (some)\n"
            "base/case.yaml:5: fluid.density: -1 g/cm3: must be positive (mass per volume)\n"
            "base/case.yaml:6: fluid.curve: none.csv: no such file or folder: base/none.csv (over time)\n"
            "base/case.yaml:7: fluid.anglse: unknown field; did you mean 'angles'?\n"
            "base/case.yaml:8: flud: unknown section; did you mean 'fluid'?");
  const CaseFile file(over("fluid: {angles: [1]}\n"));
  EXPECT_EQ(file.where("fluid.angles"), (test_folder() / "over/case.yaml:3: fluid.angles").string());
  EXPECT_EQ(file.where("fluid.density"), (test_folder() / "base/case.yaml:5: fluid.density").string());
  EXPECT_EQ(file.where("time.end"), (test_folder() / "base/case.yaml:3: time.end").string());
  EXPECT_EQ(file.where("solid.density"), (test_folder() / "over/case.yaml:1: solid.density").string());
}

TEST_F(CaseTree, BasesBuildOnBases) {
  over("fluid: {density: 2, table: other.csv}\n");
  const fs::path top = write_file("top.yaml", "base: over/case.yaml\nfluid: {angles: [0]}\n");
  const Blood blood = read(top);
  EXPECT_EQ(blood.density, 2);
  EXPECT_EQ(blood.angles, std::vector{0.0});
  EXPECT_EQ(blood.table, test_folder() / "over/other.csv");
  EXPECT_EQ(blood.patches.size(), 2U);
  EXPECT_EQ(files_of_case(top),
            (std::vector<fs::path>{top, test_folder() / "over/case.yaml", test_folder() / "base/case.yaml"}));
}

TEST_F(CaseTree, RefusesBasesThatLeadNowhere) {
  const auto error_with = [](const std::string& text) {
    const fs::path path = write_file("a.yaml", text);
    return input_error_of([&] { CaseFile{path}; });
  };
  EXPECT_EQ(error_with("name: a\nbase: no.yaml\n"), "a.yaml:2: base: no.yaml: no such file");
  EXPECT_EQ(error_with("base: base\n"), "a.yaml:1: base: base: is a folder: must be a case file");
  EXPECT_EQ(error_with("base: /dev/zero\n"), "a.yaml:1: base: /dev/zero: is a device or a pipe: must be a case file");
  EXPECT_EQ(error_with("base: [a]\n"), "a.yaml:1: base: must be the path of a case file");
  EXPECT_EQ(error_with("base:\n"), "a.yaml:1: base: must be the path of a case file");
  EXPECT_EQ(error_with("base: a.yaml\n"), "a.yaml:1: base: a.yaml: a case cannot build on itself");
  write_file("b.yaml", "\nbase: ./a.yaml\n");
  EXPECT_EQ(error_with("base: b.yaml\n"), "b.yaml:2: base: a.yaml: a case cannot build on itself");
  EXPECT_EQ(
      error_with("base: base/case.yaml\nunits: SI\n"),
      "a.yaml:2: units: SI: must be the base's (cgs), whose numbers would be taken in these; leave it out, and write "
      "numbers with their unit where it differs");
  const fs::path misspelt = write_file("a.yaml", "bas: b.yaml\nname: a\nunits: cgs\ntime: {step: 1, end: 2}\n");
  EXPECT_EQ(input_error_of([&] { CaseFile(misspelt).finish(); }),
            "a.yaml:1: bas: unknown section; did you mean 'base'?");
  for (int i = 0; i < 20; ++i) write_file(fmt::format("n{}.yaml", i), fmt::format("base: n{}.yaml\n", i + 1));
  EXPECT_EQ(error_with("base: n0.yaml\n"), "n15.yaml:1: base: more than 16 files build on each other");
}

/// What marks a folder of results says all of the case, with paths that hold from the case's own folder.
TEST_F(CaseTree, RefusesMoreEntriesThanAnyCaseHas) {
  std::string text = "name: tube\nfluid:\n";
  for (int i = 0; i <= 5000; ++i) text += "  k" + std::to_string(i) + ": 1\n";
  const auto path = write_file("many.yaml", text);
  EXPECT_NE(input_error_of([&] { read_case_tree(path); }).find("more than 5000 entries in one mapping"),
            std::string::npos);
}

TEST_F(CaseTree, TheMarkOfResultsIsTheMergedCase) {
  CommandLine command;
  command.output = test_folder() / "results";
  const fs::path path = over("title: 'x: \"y\" # z'\nfluid: {density: 2, table: other.csv, angles: [1, 0.5]}\n");
  claim_and_mark_output(command, CaseFile(path));
  const YamlNode mark = read_yaml(command.output / case_as_run);
  EXPECT_EQ(mark.find("base"), nullptr);
  EXPECT_EQ(mark.find("title")->text, "x: \"y\" # z");
  const YamlNode& fluid = *mark.find("fluid");
  EXPECT_EQ(fluid.find("density")->text, "2");
  EXPECT_EQ(fluid.find("curve")->text, "../base/flow.csv");
  EXPECT_EQ(fluid.find("table")->text, "other.csv");
  EXPECT_EQ(fluid.find("patches")->find("left")->find("heat")->text, "3");
  fs::copy(command.output / case_as_run, test_folder() / "over/merged.yaml");
  EXPECT_EQ(read(test_folder() / "over/merged.yaml").curve, test_folder() / "base/flow.csv");
  EXPECT_EQ(input_error_of([&] { claim_output(command, CaseFile(path)); }), "no error");
}

TEST(YamlText, IsReadAsTheSameTree) {
  const std::string text =
      "a: {b: [1, 2e-3, 80 mmHg], c: }\nd: '~'\ne: ''\nf: 'null'\ng: \"two\\nlines\"\nh: 'x: #y'\ni: {}\nj: []\n"
      "k: [{l: 1, m: [2]}, 'a, b']\n\"n: o\": -p\nq: 'no'\nr: '- s'\n";
  const YamlNode tree = read_yaml(write_file("a.yaml", text));
  const std::string once = yaml_text(tree);
  const YamlNode again = read_yaml(write_file("b.yaml", once));
  EXPECT_EQ(yaml_text(again), once);
  EXPECT_EQ(again.find("d")->kind, YamlNode::Kind::scalar);
  EXPECT_EQ(again.find("d")->text, "~");
  EXPECT_EQ(again.find("e")->kind, YamlNode::Kind::scalar);
  EXPECT_EQ(again.find("f")->kind, YamlNode::Kind::scalar);
  EXPECT_EQ(again.find("a")->find("c")->kind, YamlNode::Kind::empty);
  EXPECT_EQ(again.find("g")->text, "two\nlines");
  EXPECT_EQ(again.find("h")->text, "x: #y");
  EXPECT_EQ(again.find("i")->kind, YamlNode::Kind::map);
  EXPECT_EQ(again.find("j")->kind, YamlNode::Kind::list);
  EXPECT_EQ(again.find("k")->items[0].find("m")->items[0].text, "2");
  EXPECT_EQ(again.find("k")->items[1].text, "a, b");
  EXPECT_EQ(again.find("n: o")->text, "-p");
  EXPECT_EQ(again.find("r")->text, "- s");
}

TEST(YamlText, HasNoLineThatIsTooLongToBeRead) {
  std::string text = "a:\n  b: [[0, 1],\n";
  for (int i = 0; i < 9000; ++i) text += "    1.2345678,\n";
  const YamlNode tree = read_yaml(write_file("a.yaml", text + "  2]\n"));
  const YamlNode again = read_yaml(write_file("b.yaml", yaml_text(tree)));
  EXPECT_EQ(again.find("a")->find("b")->items.size(), 9002U);
  EXPECT_EQ(yaml_text(again), yaml_text(tree));
}

TEST(YamlValue, IsOneValue) {
  EXPECT_EQ(input_error_of([] { yaml_value("[5] x"); }).substr(0, 8), "'[5] x':");
}

/// Of the case that it builds on too; one that is removed is none.
TEST(IdentifiedParameters, AreThoseOfTheWholeCase) {
  EXPECT_TRUE(identified_parameters(write_file("none.yaml", "name: tube\nunits: cgs\n")).empty());
  write_file("base.yaml", "identification: {parameters: {young: {of: [a, b]}, flow: {of: [c]}, ring: {}}}\n");
  const auto all = identified_parameters(
      write_file("case.yaml", "base: base.yaml\nidentification: {parameters: {flow: , spring: {of: [d]}}}\n"));
  std::vector<std::string> names;
  for (const IdentifiedParameter& parameter : all) names.push_back(parameter.name);
  EXPECT_EQ(names, (std::vector<std::string>{"young", "ring", "spring"}));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].of, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(all[1].of.empty());
}

}  // namespace case_tree_test
}  // namespace tether
