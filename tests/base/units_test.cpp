#include "common/base/units.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"

namespace tether {
namespace {

std::string error_of(const UnitSystem& units, const std::string& text, Dimension dimension) {
  try {
    units.quantity(text, dimension);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Units, SymbolsFollowTheDimension) {
  EXPECT_EQ(UnitSystem::cgs().symbol(dimension::pressure), "g/(cm s2)");
  EXPECT_EQ(UnitSystem::si().symbol(dimension::compliance), "m4 s2/kg");
  EXPECT_EQ(UnitSystem::mm_g_s().symbol(dimension::rate), "1/s");
  EXPECT_EQ(UnitSystem::si().symbol(dimension::none), "1");
}

TEST(Units, QuantitiesAreConverted) {
  const UnitSystem cgs = UnitSystem::cgs();
  EXPECT_DOUBLE_EQ(cgs.quantity("80 mmHg", dimension::pressure), 106657.6);
  EXPECT_DOUBLE_EQ(UnitSystem::mm_g_s().quantity("1 kPa", dimension::pressure), 1000.0);
  EXPECT_DOUBLE_EQ(cgs.quantity(" -2.5e-3 ", dimension::pressure), -2.5e-3);
  EXPECT_DOUBLE_EQ(cgs.quantity("+3", dimension::none), 3.0);
  EXPECT_DOUBLE_EQ(cgs.quantity("5 l/min", dimension::flow), 5000.0 / 60.0);
  EXPECT_DOUBLE_EQ(cgs.quantity("2 g/(cm s2)", dimension::pressure), 2.0) << "its own symbol";
  EXPECT_DOUBLE_EQ(UnitSystem::si().quantity("1 mmHg s/ml", dimension::resistance), 133.322e6);
}

TEST(Units, WrongQuantitiesAreNamed) {
  const UnitSystem cgs = UnitSystem::cgs();
  EXPECT_EQ(error_of(cgs, "thick", dimension::length), "'thick' is not a number");
  EXPECT_EQ(error_of(cgs, "", dimension::length), "'' is not a number");
  EXPECT_EQ(error_of(cgs, "+-5 cm", dimension::length), "'+-5 cm' is not a number");
  EXPECT_EQ(error_of(cgs, "3 ell", dimension::length), "'3 ell': unknown unit 'ell'; this field is in cm");
  EXPECT_EQ(error_of(cgs, "3 s", dimension::length), "'3 s': s is no unit of this field, which is in cm");
  EXPECT_THROW(UnitSystem::named("imperial"), InputError);
}

TEST(Units, ReportsSpeakClinicalUnits) {
  EXPECT_DOUBLE_EQ(UnitSystem::si().to_mmhg(133.322), 1.0);
  EXPECT_DOUBLE_EQ(UnitSystem::cgs().to_mm(1.0), 10.0);
  EXPECT_DOUBLE_EQ(UnitSystem::mm_g_s().to_ml_per_s(1000.0), 1.0);
}

}  // namespace
}  // namespace tether
