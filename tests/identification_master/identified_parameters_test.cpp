#include "identification_master/identified_parameters.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

const std::vector<protocol::ParameterInfo> announced{
    {"solid.a.stiffness", "", "g/(cm2 s2)", "log2", 1e5, 0, 0, infinite, 2, 1e5},
    {"solid.b.stiffness", "", "g/(cm2 s2)", "log2", 4e5, 0, 0, infinite, 2, 1e5},
    {"solid.poisson", "", "1", "bounded", 0.4, undefined, 0, 0.5, 0.3, undefined},
    {"solid.none.stiffness", "", "g/(cm2 s2)", "log2", 0, 0, 0, infinite, 2, undefined},
    {"solid.absent.stiffness", "", "g/(cm2 s2)", "log2", 0, 0, 0, infinite, 2, 3e5},
    {"fluid.shift", "", "s", "linear", 0, 0, -0.1, 0.1, undefined, undefined}};

class Parameters : public testing::Test {
 protected:
  IdentifiedParameters made(const std::string& text) const {
    std::ofstream(folder / "case.yaml")
        << "name: test\nunits: cgs\ntime: {step: 0.1, end: 1}\nidentification:\n  parameters:\n"
        << text;
    CaseFile file(folder / "case.yaml");
    IdentificationCase given;
    file.read("identification", given);
    file.finish();
    return {given, announced, file};
  }
  std::string refusal(const std::string& text) const {
    try {
      made(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  TemporaryFolder folder;
};

TEST_F(Parameters, TakeTheirPriorFromTheModel) {
  const IdentifiedParameters parameters = made("    a: {of: [solid.a.stiffness]}\n    nu: {of: [solid.poisson]}\n");
  EXPECT_DOUBLE_EQ(parameters.prior_mean()(0), std::log2(1e5));
  EXPECT_DOUBLE_EQ(parameters.prior_variances()(0), 4);
  EXPECT_NEAR(parameters.prior_mean()(1), std::log(0.4 / 0.1), 1e-14);
  const NamedValues values = parameters.values(parameters.prior_mean());
  EXPECT_EQ(values.names, (std::vector<std::string>{"solid.a.stiffness", "solid.poisson"}));
  EXPECT_NEAR(values.values[0], 1e5, 1e-6);
  EXPECT_NEAR(values.values[1], 0.4, 1e-14);
}

TEST_F(Parameters, OfAnAbsentEffectBeginAtItsScale) {
  EXPECT_DOUBLE_EQ(made("    a: {of: [solid.absent.stiffness]}\n").prior_mean()(0), std::log2(3e5));
}

TEST_F(Parameters, AFactorKeepsTheCasesProportions) {
  const IdentifiedParameters parameters =
      made("    all: {of: [solid.a.stiffness, solid.b.stiffness], factor: true, transform: log, deviation: 1}\n");
  const NamedValues values = parameters.values(Eigen::VectorXd::Constant(1, std::log(3.0)));
  EXPECT_NEAR(values.values[0], 3e5, 1e-6);
  EXPECT_NEAR(values.values[1], 12e5, 1e-6);
  EXPECT_EQ(parameters.list()[0].unit, "1");
}

TEST_F(Parameters, SharedOnesSetAllAlike) {
  const IdentifiedParameters parameters = made("    all: {of: [solid.a.stiffness, solid.b.stiffness], mean: 2e5}\n");
  const NamedValues values = parameters.values(parameters.prior_mean());
  EXPECT_NEAR(values.values[0], 2e5, 1e-6);
  EXPECT_NEAR(values.values[1], 2e5, 1e-6);
}

TEST_F(Parameters, StayWithinWhatTheModelAdmits) {
  const IdentifiedParameters parameters = made("    shift: {of: [fluid.shift], deviation: 0.2}\n");
  EXPECT_NEAR(parameters.values(VectorXd::Constant(1, 5)).values[0], 0.1 - 1e-3 * 0.1, 1e-12);
  EXPECT_NEAR(parameters.values(VectorXd::Constant(1, 0.05)).values[0], 0.05, 1e-15);
  EXPECT_EQ(parameters.moved(), 1);
}

TEST_F(Parameters, BadOnesAreNamedWithTheirLine) {
  const auto expect = [&](const std::string& text, const std::string& part) {
    const std::string told = refusal(text);
    EXPECT_NE(told.find(part), std::string::npos) << told;
    EXPECT_NE(told.find("case.yaml:6"), std::string::npos) << told;
  };
  expect("    a: {of: [solid.a.stifness]}\n", "did you mean solid.a.stiffness?");
  expect("    a: {of: [solid.none.stiffness]}\n", "0 has no logarithm (the case's value; give a mean)");
  expect("    shift: {of: [fluid.shift]}\n", "must be given: the model announces none for fluid.shift");
  expect("    a: {of: [solid.a.stiffness, solid.poisson]}\n", "one parameter cannot set both");
  expect("    a: {of: [solid.a.stiffness], transform: bounded}\n", "must be given for a bounded parameter");
  EXPECT_NE(refusal("    a: {of: [solid.a.stiffness]}\n    b: {of: [solid.a.stiffness]}\n").find("already set by a"),
            std::string::npos);
}

}  // namespace
}  // namespace tether
