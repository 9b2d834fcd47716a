#include "tests/config/case_text.hpp"

namespace tether {
namespace effect_test {

const EffectDeclaration spring{
    "spring",
    "pulls back in proportion to the displacement",
    Place::ring,
    {{"stiffness", "traction per displacement", dimension::support_stiffness, range::not_negative, undefined, 0},
     {"damping", "traction per velocity", dimension::support_damping, range::not_negative, 50, 0}}};  // in SI
const EffectDeclaration moving{
    "moving",
    "follows a prescribed motion",
    Place::ring,
    {{"stiffness", "traction per distance", dimension::support_stiffness, range::positive, 70, undefined}}};  // in SI
const EffectDeclaration clamped{"clamped", "does not move", Place::ring, {}};
const EffectDeclaration* const family[] = {&clamped, &spring, &moving};

struct Ring {
  EffectCase law{"clamped", {}};
  std::filesystem::path motion;
  void declare(Fields& f) {
    f.effect(law, family, "how the end ring is held");
    f.when("type", law.type, {"moving"}, [&] { f.path("motion", motion, "table of motions", Need::required); });
  }
};

Ring ring_of(const std::string& text) {
  const auto path = write_file("case.yaml", valid_head + "fluid: " + text);
  CaseFile file(path);
  Ring ring;
  file.read("fluid", ring);
  file.finish();
  return ring;
}

TEST(EffectOfACase, TakesTypeAndParametersInTheOrderOfTheDeclaration) {
  EXPECT_EQ(ring_of("{}\n").law.type, "clamped");
  EXPECT_TRUE(ring_of("{}\n").law.values.empty());
  EXPECT_EQ(ring_of("{type: spring, stiffness: 3}\n").law.values, (std::vector{3.0, 5.0}));
  EXPECT_EQ(ring_of("{type: spring, damping: 1, stiffness: 3 kPa/mm}\n").law.values, (std::vector{3e5, 1.0}));
}

TEST(EffectOfACase, MayNeedMoreThanNumbers) {
  write_file("m.csv", "t\n0\n");
  const Ring ring = ring_of("{type: moving, motion: m.csv}\n");
  EXPECT_EQ(ring.law.values, (std::vector{7.0}));
  EXPECT_EQ(ring.motion, test_folder() / "m.csv");
}

TEST(EffectOfACase, KeepsADefaultWithValues) {
  Ring ring{{"spring", {1.0, 2.0}}, {}};
  const auto path = write_file("case.yaml", valid_head + "fluid: {damping: 9}\n");
  CaseFile file(path);
  file.read("fluid", ring);
  file.finish();
  EXPECT_EQ(ring.law.values, (std::vector{1.0, 9.0}));
}

TEST(EffectOfACase, NamesWhatIsWrong) {
  EXPECT_EQ(errors_in<Ring>("fluid: {type: spring, stiffness: -3}\n"),
            "case.yaml:6: fluid.stiffness: -3 g/(cm2 s2): must not be negative (traction per displacement)");
  EXPECT_EQ(errors_in<Ring>("fluid: {type: spring}\n"),
            "case.yaml:6: fluid.stiffness: missing: must be given in g/(cm2 s2) (traction per displacement)");
  EXPECT_EQ(errors_in<Ring>("fluid: {type: sprng, stiffness: 1}\n"),
            "case.yaml:6: fluid.type: sprng: must be one of clamped, spring, moving; did you mean 'spring'? (how the "
            "end ring is held)");
  EXPECT_EQ(errors_in<Ring>("fluid: {type: clamped, stiffness: 1}\n"),
            "case.yaml:6: fluid.stiffness: only with 'type: spring or moving'; here type is 'clamped'");
  EXPECT_EQ(errors_in<Ring>("fluid: {type: moving, dampng: 1}\n"),
            "case.yaml:6: fluid.motion: missing: must be given (table of motions)\n"
            "case.yaml:6: fluid.dampng: unknown field; known here: type, stiffness, motion");
  EXPECT_EQ(errors_in<Ring>("fluid: {}\n", Ring{{"", {}}, {}}),
            "case.yaml:6: fluid.type: missing: must be given (how the end ring is held)");
}

}  // namespace effect_test
}  // namespace tether
