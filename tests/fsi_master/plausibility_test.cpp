#include "fsi_master/plausibility.hpp"

#include <gtest/gtest.h>

namespace tether {
namespace {

protocol::ParameterInfo parameter(const std::string& name, double value) {
  protocol::ParameterInfo info;
  info.name = name;
  info.value = value;
  return info;
}

TEST(Plausibility, AnAortaInItsOwnUnitsIsUsual) {
  EXPECT_TRUE(unusual_numbers({parameter("fluid.density", 1.06), parameter("solid.material.young", 4e6),
                               parameter("fluid.rheology.viscosity", 0.04), parameter("solid.material.poisson", 0.45)},
                              UnitSystem::cgs())
                  .empty());
  EXPECT_EQ(unusual_image_pressure(70.9 * 1333.22, UnitSystem::cgs()), "");
  EXPECT_EQ(unusual_image_pressure(0, UnitSystem::cgs()), "");
}

TEST(Plausibility, MistakesOfUnitsAreNamed) {
  const auto found =
      unusual_numbers({parameter("fluid.density", 1060), parameter("solid.material.young", 40)}, UnitSystem::cgs());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "fluid.density is 1.06e+06 kg/m3; blood and tissue have about 1000: are the case's units right?");
  EXPECT_TRUE(found[1].starts_with("solid.material.young is 4 Pa;")) << found[1];
  EXPECT_EQ(unusual_image_pressure(70.9, UnitSystem::cgs()),
            "image.pressure is 0.0532 mmHg: are the case's units right?");
}

}  // namespace
}  // namespace tether
