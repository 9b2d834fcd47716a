#include "common/config/describe_effects.hpp"

#include <gtest/gtest.h>

#include "common/config/case.hpp"

namespace tether {
namespace describe_test {

const EffectDeclaration still{"still", "does not move", Place::ring, {}};
const EffectDeclaration spring{
    "spring",
    "pulls back",
    Place::ring,
    {{"stiffness", "traction per way", dimension::support_stiffness, range::not_negative, 30, 0}},  // in SI
    EffectRole::holds,
    EffectTarget::whole,
    true,
    "still"};
const EffectDeclaration* const family[] = {&still, &spring};

struct Ring {
  EffectCase law{"still", {}};
  void declare(Fields& f) { f.effect(law, family, "how it is held"); }
};

struct Wall {
  double density = undefined;
  Named<Ring> rings;
  std::optional<TimeCase> window;
  void declare(Fields& f) {
    f.number("density", density, dimension::density, range::positive, "mass | volume");
    f.groups("rings", rings, "end rings by name");
    f.group("window", window, "a part of the run");
  }
};

Describe described() {
  Describe describe(UnitSystem::cgs());
  Wall wall;
  describe.group("solid", wall, "the wall");
  return describe;
}

TEST(Describe, ListsEveryFieldWithUnitDefaultRuleAndCondition) {
  EXPECT_EQ(described().text(), R"(solid  (section)
    the wall
solid.density [g/cm3]  (number; must be given; must be positive)
    mass | volume
solid.rings  (section)
    end rings by name
solid.rings.NAME.type  (choice; default still)
    how it is held
      still: does not move
      spring: pulls back
solid.rings.NAME.stiffness [g/(cm2 s2)]  (number; default 3; must not be negative; with type: spring)
    traction per way
solid.window  (section; may be absent)
    a part of the run
solid.window.step [s]  (number; must be given; must be positive)
    time step
solid.window.end [s]  (number; must be given)
    time at which the run ends
solid.window.start [s]  (number; default 0)
    time at which the run starts
)");
}

TEST(Describe, WritesATablePerSection) {
  const std::string page = described().markdown();
  EXPECT_EQ(page.substr(0, page.find("| `solid.rings`")), R"(
## solid

| field | kind | unit | default | allowed | meaning |
|---|---|---|---|---|---|
| `solid` | section |  |  |  | the wall |
| `solid.density` | number | g/cm3 | must be given | must be positive | mass \| volume |
)");
  EXPECT_NE(
      page.find(
          "| `solid.rings.NAME.type` | choice |  | default still |  | how it is held<br>`still`: does not move<br>"
          "`spring`: pulls back |\n"),
      std::string::npos);
  EXPECT_NE(page.find("| traction per way (`with type: spring`) |\n"), std::string::npos);
}

struct Vessel {
  std::string source = "swept";
  Ring ring;
  void declare(Fields& f) {
    f.choice("source", source, {{"swept", "generated"}, {"files", "read"}}, "origin");
    f.when("source", source, {"swept"}, [&] { f.group("ring", ring, "at the end"); });
  }
};

TEST(Describe, SaysAConditionOnceForASection) {
  Describe describe(UnitSystem::cgs());
  Vessel vessel;
  describe.group("mesh", vessel, {});
  const std::string text = describe.text();
  EXPECT_NE(text.find("mesh.ring  (section; with source: swept)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("mesh.ring.type  (choice; default still)\n"), std::string::npos) << text;
}

TEST(Describe, CommonFieldsStandUnderOneHeading) {
  Describe describe(UnitSystem::cgs());
  CommonCase common;
  common.declare(describe);
  EXPECT_EQ(describe.markdown().find("\n## top level\n"), 0u);
  EXPECT_NE(describe.markdown().find("\n## time\n"), std::string::npos);
}

TEST(DescribeEffects, ListsEachEffectOnceWithWhatThereIsToSayOfItsNumbers) {
  DescribeEffects describe(UnitSystem::cgs());
  Wall wall;
  wall.declare(describe);
  wall.declare(describe);
  const std::string text = describe.markdown();
  EXPECT_NE(
      text.find(
          "## on an end ring: spring\n\npulls back. As `type` of `rings.NAME`. Role: holds, on the whole at once, a "
          "variant of `still`, generic.\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("does not move. As `type` of `rings.NAME`. Role: replaces.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| `stiffness` | g/(cm2 s2) | not negative | 3 | 0 | linear |  |  | traction per way |"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("## on an end ring: spring"), text.rfind("## on an end ring: spring"));
}

}  // namespace describe_test
}  // namespace tether
