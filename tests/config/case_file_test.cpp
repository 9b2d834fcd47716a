#include "tests/config/case_text.hpp"

namespace tether {
namespace case_file_test {

struct Outlet {
  double compliance = undefined;
  std::optional<double> offset;
  void declare(Fields& f) {
    f.number("compliance", compliance, dimension::compliance, range::positive, "volume stored per pressure");
    f.number("offset", offset, dimension::pressure, range::any, "of its pressure");
  }
};

struct Blood {
  double density = undefined, factor = 0.2;
  int layers = 2;
  bool moving = true;
  std::string label, motion = "elastic";
  std::filesystem::path file;
  std::vector<double> angles;
  std::vector<std::string> masks;
  Vec3 axis{1, 0, 0};
  Named<Outlet> outlets;
  std::optional<Outlet> extra;
  void declare(Fields& f) {
    f.number("density", density, dimension::density, range::positive, "mass per volume");
    f.number("factor", factor, dimension::none, {0.0, 0.5, false, true}, "a share");
    f.integer("layers", layers, {1, 8}, "thin layers");
    f.flag("moving", moving, "whether the wall moves");
    f.text("label", label, "for plots");
    f.choice("motion", motion, {{"elastic", "as a solid"}, {"harmonic", "as a membrane"}}, "of the mesh");
    f.path("file", file, "a table");
    f.numbers("angles", angles, {2, dimension::none, {0, 360}}, "from and to");
    f.texts("masks", masks, "parts");
    f.point("axis", axis, dimension::length, "direction");
    f.groups("outlets", outlets, "by name");
    f.group("extra", extra, "one more");
    f.check(layers < 5 || factor > 0.1, "layers", "needs factor > 0.1 above 4");
  }
};

TEST(CaseFile, ReadsEveryKindOfField) {
  write_file("q.csv", "time\n0\n");
  const auto path = write_file("case.yaml", valid_head + R"(title: A tube
output: {write_every: 5, points: {middle: [-2, 0, 50 mm]}}
fluid:
  density: 1060 kg/m3
  factor: 0.25
  layers: 4
  moving: no
  label: "x: y"
  motion: harmonic
  file: q.csv
  angles: [10, 20.5]
  axis: [0, 1, 2]
  outlets:
    left: {compliance: 1.5e-3}
    anterior: {compliance: 1 ml/mmHg, offset: 80 mmHg}
)");
  CaseFile file(path);
  Blood blood;
  file.read("fluid", blood);
  file.finish();
  EXPECT_EQ(file.common().title, "A tube");
  EXPECT_EQ(file.common().titled(", coarser"), "A tube, coarser");
  CommonCase nameless = file.common();
  nameless.title.clear();
  EXPECT_EQ(nameless.titled(", coarser"), nameless.name + ", coarser");
  EXPECT_EQ(file.common().output.points[0].first, "middle");
  EXPECT_DOUBLE_EQ(file.common().output.points[0].second.z(), 5.0);
  EXPECT_EQ(file.common().output.checkpoint_every, 50);
  EXPECT_EQ(file.common().time.steps(), 450);
  EXPECT_DOUBLE_EQ(blood.density, 1.06);
  EXPECT_EQ(blood.factor, 0.25);
  EXPECT_EQ(blood.layers, 4);
  EXPECT_FALSE(blood.moving);
  EXPECT_EQ(blood.label, "x: y");
  EXPECT_EQ(blood.motion, "harmonic");
  EXPECT_EQ(blood.file, test_folder() / "q.csv");
  EXPECT_EQ(blood.angles, (std::vector{10.0, 20.5}));
  EXPECT_EQ(blood.axis, Vec3(0, 1, 2));
  ASSERT_EQ(blood.outlets.size(), 2u);
  EXPECT_EQ(blood.outlets[0].first, "left") << "the order of the file is kept";
  EXPECT_FALSE(blood.outlets[0].second.offset.has_value());
  EXPECT_NEAR(*blood.outlets[1].second.offset, 106657.6, 1e-9);
  EXPECT_FALSE(blood.extra.has_value());
  EXPECT_EQ(file.given("fluid.motion"), "harmonic");
  EXPECT_EQ(file.given("fluid.extra.offset"), "");
  EXPECT_EQ(file.given("wall.element"), "");
  EXPECT_EQ(file.where("fluid.outlets.left"), (test_folder() / "case.yaml:19: fluid.outlets.left").string());
  EXPECT_EQ(file.where("fluid.extra.compliance"), (test_folder() / "case.yaml:8: fluid.extra.compliance").string());
}

TEST(CaseFile, StepsReachTheEnd) {
  EXPECT_EQ((TimeCase{1e-3, 0.9, 0.0}.steps()), 900);
  EXPECT_EQ((TimeCase{0.1, 0.3, 0.0}.steps()), 3);
  EXPECT_EQ((TimeCase{0.4, 0.9, 0.0}.steps()), 3);
  EXPECT_EQ((TimeCase{0.1, 1.0, 0.5}.steps()), 5);
}

struct Wrong {
  const char *text, *message;
};

class WrongCase : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongCase, IsNamedWithItsLine) {
  EXPECT_EQ(errors_in<Blood>(GetParam().text), GetParam().message);
}

const Wrong wrong_cases[] = {
    {"fluid: {density: -3}\n", "case.yaml:6: fluid.density: -3 g/cm3: must be positive (mass per volume)"},
    {"fluid: {density: -3 kg/m3}\n", "case.yaml:6: fluid.density: -3 kg/m3: must be positive (mass per volume)"},
    {"fluid: {density: 1, factor: 0.5}\n",
     "case.yaml:6: fluid.factor: 0.5: must be at least 0 and below 0.5 (a share)"},
    {"fluid: {density: heavy}\n", "case.yaml:6: fluid.density: 'heavy' is not a number (mass per volume)"},
    {"fluid: {density: .nan}\n", "case.yaml:6: fluid.density: '.nan' is not a number (mass per volume)"},
    {"fluid: {density: nan}\n", "case.yaml:6: fluid.density: nan: must be finite (mass per volume)"},
    {"fluid: {density: 1e300}\n",
     "case.yaml:6: fluid.density: 1e300 g/cm3: must be from -1e+20 to 1e+20 (mass per volume)"},
    {"fluid: {density: 1e18 kg/m3, factor: 1e-320}\n", "no error"},
    {"fluid: {density: 1e-320}\n",
     "case.yaml:6: fluid.density: 1e-320 g/cm3: is too near to zero: must be 1e-30 or more away (mass per volume)"},
    {"fluid: {density: 1e999}\n", "case.yaml:6: fluid.density: '1e999' is not a number (mass per volume)"},
    {"fluid: {density: 3 mmHg}\n",
     "case.yaml:6: fluid.density: '3 mmHg': mmHg is no unit of this field, which is in g/cm3 (mass per volume)"},
    {"fluid: {density: 3 stone}\n",
     "case.yaml:6: fluid.density: '3 stone': unknown unit 'stone'; this field is in g/cm3 (mass per volume)"},
    {"fluid: {density: 1, factor: 0.1 cm}\n",
     "case.yaml:6: fluid.factor: '0.1 cm': cm is no unit of this field, which has none (a share)"},
    {"fluid:\n  factor: 0.1\n", "case.yaml:6: fluid.density: missing: must be given in g/cm3 (mass per volume)"},
    {"fluid: {density: }\n", "case.yaml:6: fluid.density: missing: must be given in g/cm3 (mass per volume)"},
    {"", "case.yaml:1: fluid.density: missing: must be given in g/cm3 (mass per volume)"},
    {"fluid: {density: [1, 2]}\n", "case.yaml:6: fluid.density: a list: must be a single value (mass per volume)"},
    {"fluid: {density: {value: 1}}\n",
     "case.yaml:6: fluid.density: a section: must be a single value (mass per volume)"},
    {"fluid: {density: 1, densty: 2}\n", "case.yaml:6: fluid.densty: unknown field; did you mean 'density'?"},
    {"fluid: {density: 1, fax: 2}\n",
     "case.yaml:6: fluid.fax: unknown field; known here: density, factor, layers, moving, label, motion, file, angles, "
     "masks, axis, outlets, extra"},
    {"fluid: {density: 1, layers: 2.5}\n", "case.yaml:6: fluid.layers: 2.5: must be a whole number (thin layers)"},
    {"fluid: {density: 1, layers: 9}\n",
     "case.yaml:6: fluid.layers: 9: must be at least 1 and at most 8 (thin layers)"},
    {"fluid: {density: 1, moving: maybe}\n",
     "case.yaml:6: fluid.moving: maybe: must be true or false (whether the wall moves)"},
    {"fluid: {density: 1, motion: elstic}\n",
     "case.yaml:6: fluid.motion: elstic: must be one of elastic, harmonic; did you mean 'elastic'? (of the mesh)"},
    {"fluid: {density: 1, motion: magic}\n",
     "case.yaml:6: fluid.motion: magic: must be one of elastic, harmonic (of the mesh)"},
    {"fluid: {density: 1, file: none.csv}\n",
     "case.yaml:6: fluid.file: none.csv: no such file or folder: none.csv (a table)"},
    {"fluid: {density: 1, file: /dev/zero}\n",
     "case.yaml:6: fluid.file: /dev/zero: must be a file or a folder, not a device (a table)"},
    {"fluid: {density: 1, angles: [1, 2, 3]}\n",
     "case.yaml:6: fluid.angles: 3 numbers: must be 2 numbers (from and to)"},
    {"fluid: {density: 1, angles: 3}\n",
     "case.yaml:6: fluid.angles: a single value: must be a list of numbers (from and to)"},
    {"fluid: {density: 1, angles: [1, [2]]}\n", "case.yaml:6: fluid.angles: a list: must be a number (from and to)"},
    {"fluid: {density: 1, angles: [1, 400]}\n",
     "case.yaml:6: fluid.angles: 400: must be at least 0 and at most 360 (from and to)"},
    {"fluid: {density: 1, masks: spine}\n",
     "case.yaml:6: fluid.masks: a single value: must be a list of words (parts)"},
    {"fluid: {density: 1, masks: [spine, [a]]}\n", "case.yaml:6: fluid.masks: a list: must be a word (parts)"},
    {"fluid: {density: 1, outlets: {left: 3}}\n",
     "case.yaml:6: fluid.outlets.left: a single value: must be a section of named fields"},
    {"fluid:\n  density: 1\n  outlets:\n    left: {}\n",
     "case.yaml:9: fluid.outlets.left.compliance: missing: must be given in cm4 s2/g (volume stored per pressure)"},
    {"fluid:\n  density: 1\n  extra: {compliance: 0}\n",
     "case.yaml:8: fluid.extra.compliance: 0 cm4 s2/g: must be positive (volume stored per pressure)"},
    {"fluid: {density: 1, layers: 6, factor: 0.05}\n", "case.yaml:6: fluid.layers: 6: needs factor > 0.1 above 4"},
    {"fluid: {density: 1}\nflud: {}\n", "case.yaml:7: flud: unknown section; did you mean 'fluid'?"},
    {"fluid: {density: 1}\nname: again\n", "case.yaml:7: 'name' is given twice; first on line 1"},
    {"fluid: {density: 1\n", "case.yaml:7: not YAML: end of map flow not found"},
    {"# 'a, and the \"others\nfluid: {density: 1\nb: 'c' # \"d\n", "case.yaml:8: not YAML: end of map flow not found"},
    {"fluid: {density: 1}\n---\nname: b\n", "case.yaml:7: a second document starts here; a case file has one"},
    {"fluid: &a {density: 1, extra: *a}\n", "case.yaml:6: nested too deeply (an alias that contains itself?)"},
    {"fluid: {density: 1, motion: \"har\\nmonic\"}\n",
     "case.yaml:6: fluid.motion: har?monic: must be one of elastic, harmonic; did you mean 'harmonic'? (of the mesh)"},
    {"fluid: {density: \"1\\n2\"}\n",
     "case.yaml:6: fluid.density: '1?2': unknown unit '?2'; this field is in g/cm3 (mass per volume)"},
    {"title: \"a\\u202Eb\"\nfluid: {density: 1}\n", "case.yaml:6: title: a?b: must not hold control characters"},
    {"title: \"a\\u2028b\"\nfluid: {density: 1}\n", "case.yaml:6: title: a?b: must not hold control characters"},
    {"title: \"Small tube\nfluid: {density: 1}\n", "case.yaml:6: a quote is opened here and not closed on this line"},
    {"title: \"Small tube\nfluid:\n  density: 1\n  label: \"x\"\n",
     "case.yaml:6: a quote is opened here and not closed on this line"},
    {"fluid:\n  label: 'Small tube\n  density: 1\noutput: {points: {'p': [0, 0, 1]}}\n",
     "case.yaml:7: a quote is opened here and not closed on this line"},
    {"fluid: {label: \"Small tube, density: 1}\noutput:\n  points: {\"p\": [0, 0, 1]}\n",
     "case.yaml:6: a quote is opened here and not closed on this line"},
    {"fluid: {masks: [\"a\", 'b, \"c\"], density: 1}\noutput:\n  points: {'p': [0, 0, 1]}\n",
     "case.yaml:6: a quote is opened here and not closed on this line"},
    {"fluid:\n  masks:\n    - \"a\n  density: 1\noutput: {points: {\"p\": [0, 0, 1]}}\n",
     "case.yaml:8: a quote is opened here and not closed on this line"},
    {"fluid:\n  layers: 0\n  densty: 1\n",
     "case.yaml:6: fluid.density: missing: must be given in g/cm3 (mass per volume)\n"
     "case.yaml:7: fluid.layers: 0: must be at least 1 and at most 8 (thin layers)\n"
     "case.yaml:8: fluid.densty: unknown field; did you mean 'density'?"},
};

INSTANTIATE_TEST_SUITE_P(All, WrongCase, ::testing::ValuesIn(wrong_cases));

std::string error_of_whole(const std::string& text) {
  const auto path = write_file("case.yaml", text);
  return input_error_of([&] { CaseFile(path).finish(); });
}

TEST(CaseFile, QuotesALongValueInPart) {
  const std::string told =
      error_of_whole("name: a\nunits: cgs\ntime: {step: 1, end: " + std::string(60'000, 'x') + "}\n");
  EXPECT_LT(told.size(), 2100U);
  EXPECT_TRUE(told.starts_with("case.yaml:3: time.end: 'xxx")) << told;
  EXPECT_NE(told.find("xxx ... xxx"), std::string::npos) << told;
  EXPECT_NE(told.find("number"), std::string::npos) << told;
}

/// Paths of fields are split at dots where a case is written that builds on another.
TEST(CaseFile, NamesOfSectionsHaveNoDot) {
  EXPECT_EQ(errors_in<Blood>("fluid:\n  density: 1\n  outlets: {a.b: {compliance: 1}, c: {compliance: 1}}\n"),
            "case.yaml:8: fluid.outlets.a.b: a name in a case has no dot, which stands between names of a path");
  EXPECT_EQ(errors_in<Blood>("output: {points: {p.1: [0, 0, 0]}}\nfluid: {density: 1}\n"),
            "case.yaml:6: output.points.p.1: a name in a case has no dot, which stands between names of a path");
}

TEST(CaseFile, NamesWhatTheHeadLacks) {
  EXPECT_EQ(error_of_whole(""),
            "case.yaml:1: name: missing: must be given (short name of the case, also of its output folder)\n"
            "case.yaml:1: units: missing: must be given (unit system of all numbers that carry no unit of their own)\n"
            "case.yaml:1: time.step: missing: must be given in s (time step)\n"
            "case.yaml:1: time.end: missing: must be given in s (time at which the run ends)");
  EXPECT_EQ(error_of_whole("name: a/b\nunits: cgi\ntime: {step: 0.1, end: -1}\n"),
            "case.yaml:1: name: a/b: must consist of letters, digits, '_', '-' and '.', at most 200 of them\n"
            "case.yaml:2: units: cgi: must be one of cgs, SI, mm-g-s; did you mean 'cgs'? "
            "(unit system of all numbers that carry no unit of their own)\n"
            "case.yaml:3: time.end: -1: must be after time.start");
  EXPECT_NE(error_of_whole("name: " + std::string(300, 'a') + "\n").find(", at most 200 of them\n"), std::string::npos);
  EXPECT_EQ(error_of_whole("just words\n"),
            "case.yaml:1: a case file is a section of named fields, such as 'name: tube'");
}

TEST(CaseFile, MayHaveQuotesOfSeveralLines) {
  const std::string title =
      "title: \"It's \\\"a\\\" tube:\n  of\n\n  two lines\" # it's so\nfluid: {density: 1, label: 'it''s'}\n";
  EXPECT_EQ(errors_in<Blood>(title), "no error");
  EXPECT_EQ(errors_in<Blood>("# a \"\ntitle: it's\nfluid: {density: 1}\n"), "no error");
  EXPECT_EQ(errors_in<Blood>("title: |\n  \"a\n  b: c\nfluid: {density: 1}\n"), "no error");
}

TEST(CaseFile, IsUtf8WithoutOrWithAMark) {
  std::string wide;
  for (const char c : valid_head + "fluid: {density: 1}\n") wide += std::string(1, '\0') + c;
  EXPECT_EQ(error_of_whole(wide), "case.yaml:1: is not UTF-8; save the file in that encoding");
  EXPECT_EQ(error_of_whole("\xFE\xFF" + wide), "case.yaml:1: is not UTF-8; save the file in that encoding");
  EXPECT_EQ(error_of_whole(valid_head + "title: a" + std::string(1, '\0')),
            "case.yaml:6: is not UTF-8; save the file in that encoding");
  EXPECT_EQ(error_of_whole("\xEF\xBB\xBF" + valid_head), "no error");
  EXPECT_EQ(error_of_whole("\xEF\xBB\xBF" + valid_head + "title: \"a\nfluid: {}\n"),
            "case.yaml:6: a quote is opened here and not closed on this line");
}

TEST(CaseFile, IsAsLongAsPersonsWriteThem) {
  EXPECT_EQ(error_of_whole(valid_head + "title: " + std::string(65'000, 'a') + "\n"), "no error");
  EXPECT_EQ(error_of_whole(valid_head + "title: " + std::string(66'000, 'a') + "\n"),
            "case.yaml:6: has more than 65536 bytes: must be several lines");
  std::string comments;
  while (comments.size() < 2'000'000) comments += "# " + std::string(98, 'a') + "\n";
  EXPECT_EQ(error_of_whole(comments + valid_head), "case.yaml: has more than 2000000 bytes: is it a case file?");
}

/// A value may be a page; the message that quotes it is a line.
TEST(CaseFile, IsQuotedWithoutTheMiddleOfWhatIsLong) {
  const std::string page(60'000, 'a'), shown = std::string(30, 'a') + " ... " + std::string(30, 'a');
  for (const std::string& text : {"fluid: {density: 1, motion: " + page + "}\n", "fluid: {density: " + page + "}\n",
                                  "fluid: {density: 1, ? " + page + " : 1}\n", "fluid: {density: 1 " + page + "}\n",
                                  "? " + page + "\n: 1\n? " + page + "\n: 1\n"}) {
    const std::string said = errors_in<Blood>(text);
    EXPECT_LT(said.size(), 500U) << said;
    EXPECT_NE(said.find("aaa ... "), std::string::npos) << said;
  }
  EXPECT_NE(errors_in<Blood>("fluid: {density: 1, motion: " + page + "}\n").find("motion: " + shown + ": must be one"),
            std::string::npos);
}

TEST(CaseFile, NamesAFileThatCannotBeRead) {
  EXPECT_EQ(input_error_of([] { CaseFile("no/such.yaml"); }), "no/such.yaml: no such file");
  EXPECT_EQ(input_error_of([] { CaseFile("/tmp"); }), "/tmp: is not a file");
}

TEST(CaseFile, UnitsOfTheCaseGovernItsNumbers) {
  const auto path =
      write_file("case.yaml", "name: a\nunits: SI\ntime: {step: 2 ms, end: 1}\nfluid: {density: 1.06 g/cm3}\n");
  CaseFile file(path);
  Blood blood;
  file.read("fluid", blood);
  file.finish();
  EXPECT_DOUBLE_EQ(blood.density, 1060.0);
  EXPECT_DOUBLE_EQ(file.common().time.step, 2e-3);
  EXPECT_EQ(file.units().name(), "SI");
}

}  // namespace case_file_test
}  // namespace tether
