#include "identification_master/identified_parameters.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "identification_master/application.hpp"
#include "identification_master/estimate_files.hpp"
#include "identification_master/identified_case.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

const std::vector<protocol::ParameterInfo> announced{
    {"solid.a.stiffness", "", "g/(cm2 s2)", "log2", 1e5, 0, 0, infinite, 2, 1e5},
    {"solid.b.stiffness", "", "g/(cm2 s2)", "log2", 4e5, 0, 0, infinite, 2, 1e5},
    {"solid.poisson", "", "1", "bounded", 0.4, undefined, 0, 0.5, 0.3, undefined},
    {"solid.none.stiffness", "", "g/(cm2 s2)", "log2", 0, 0, 0, infinite, 2, undefined},
    {"solid.absent.stiffness", "", "g/(cm2 s2)", "log2", 0, 0, 0, infinite, 2, 3e5},
    {"fluid.shift", "", "s", "linear", 0, 0, -0.1, 0.1, undefined, undefined},
    {"fluid.age", "", "s", "linear", 50, undefined, 0, infinite, 5, undefined}};

class Parameters : public ::testing::Test {
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

TEST_F(Parameters, OutputsSayTheValueThatIsRun) {
  const IdentifiedParameters parameters =
      made("    a: {of: [solid.a.stiffness], upper: 2e5}\n    nu: {of: [solid.poisson]}\n");
  const VectorXd beyond = Eigen::Vector2d(std::log2(8e5), 0);
  const double run = parameters.values(beyond).values[0];
  EXPECT_NEAR(run, 2e5 - 1e-3 * 1e5, 1e-6);
  const IdentifiedParameter& a = parameters.list()[0];
  EXPECT_EQ(a.value(beyond(0)), run);
  EXPECT_TRUE(a.is_moved(beyond(0)));
  EXPECT_FALSE(a.is_moved(a.prior_mean));
  const ValueEstimate estimate = estimate_of(a, beyond(0), 3);
  EXPECT_EQ(estimate.median, run);
  EXPECT_NEAR(estimate.lower, 8e5 * std::exp2(-1.959963984540054 * 3), 1);
  EXPECT_EQ(estimate.upper, 2e5) << "the interval ends at the bound";
  EXPECT_EQ(estimate_of(a, std::log2(8e5), 0.1).lower, run);

  const CaseFile file(folder / "case.yaml");
  write_identified_case(folder / "identified.yaml", file, parameters, beyond);
  const CaseFile found(folder / "identified.yaml");
  EXPECT_DOUBLE_EQ(std::stod(found.given("solid.a.stiffness")), run);
  EstimateTable table(folder.path(), parameters);
  table.start({.mean = beyond, .covariance = MatrixXd::Identity(2, 2)});
  EXPECT_DOUBLE_EQ(CsvTable(folder / "estimate.csv").numbers("a").front(), run);
  EXPECT_EQ(parameters.moved(), 1) << "writing is no move";
}

TEST_F(Parameters, OfAFactorAreBoundedByAllItsNumbers) {
  const IdentifiedParameters parameters =
      made("    nu: {of: [solid.poisson], factor: true, transform: linear, deviation: 0.1}\n");
  const NamedValues values = parameters.values(VectorXd::Constant(1, 2));
  EXPECT_NEAR(values.values[0], 0.5 - 1e-3 * 0.1, 1e-12);
  EXPECT_NEAR(parameters.list()[0].value(2) * 0.4, values.values[0], 1e-14) << "the factor that is run";
}

TEST_F(Parameters, ToldInAnotherThetaKeepTheAnnouncedDeviation) {
  const auto deviation = [&](const std::string& text) { return made(text).list()[0].prior_deviation; };
  EXPECT_NEAR(deviation("    a: {of: [solid.a.stiffness], transform: log}\n"), 2 * std::log(2), 1e-12);
  EXPECT_NEAR(deviation("    a: {of: [solid.a.stiffness], factor: true}\n"), 2, 1e-12) << "a factor of four";
  EXPECT_NEAR(deviation("    nu: {of: [solid.poisson], transform: linear}\n"), 0.3 * 0.4 * 0.1 / 0.5, 1e-12);
  EXPECT_NEAR(deviation("    age: {of: [fluid.age], factor: true}\n"), 5.0 / 50, 1e-12) << "of a factor, not of 50";
  EXPECT_NE(refusal("    a: {of: [solid.a.stiffness], transform: linear}\n").find("deviation: must be given"),
            std::string::npos)
      << "a factor of four either way is no normal distribution of the value";
}

class Inherited : public Parameters {
 protected:
  Inherited() {
    Estimate earlier;
    earlier.corrected = true;
    for (const auto& [name, theta] : {std::pair{"a", 17.0}, {"rest", 12.0}}) {
      EstimatedParameter p;
      p.name = name, p.unit = "g/(cm2 s2)", p.transform = "log2";
      p.estimate = {.value = std::exp2(theta), .theta = theta};
      earlier.parameters.push_back(p);
    }
    earlier.covariance_of_theta = covariance;
    earlier.correlations = earlier.identifiability.gramian = earlier.identifiability.directions = covariance;
    write_record(folder / "estimate.json", earlier);
    earlier.corrected = false;
    write_record(folder / "watched.json", earlier);
    earlier.corrected = true;
    earlier.covariance_of_theta(1, 1) = -0.5;
    write_record(folder / "negative.json", earlier);
    earlier.covariance_of_theta << 0.25, 0.4, 0.4, 0.5;
    write_record(folder / "impossible.json", earlier);
    earlier.covariance_of_theta << 0.25, 0.1, -0.1, 0.5;
    write_record(folder / "lopsided.json", earlier);
    earlier.covariance_of_theta = covariance;
    earlier.parameters.back().estimate.theta = undefined;
    write_record(folder / "empty.json", earlier);
  }
  const MatrixXd covariance = (MatrixXd(2, 2) << 0.25, -0.1, -0.1, 0.5).finished();
  const std::string prior = "  prior_from: estimate.json\n";
};

TEST_F(Inherited, BeginWithMeansAndCovarianceOfAnEarlierIdentification) {
  const IdentifiedParameters parameters = made(
      "    a: {of: [solid.a.stiffness]}\n    b: {of: [solid.b.stiffness], part_of: rest, deviation: 0.3}\n"
      "    c: {of: [solid.absent.stiffness], part_of: rest, deviation: 0.4}\n    nu: {of: [solid.poisson]}\n" +
      prior);
  EXPECT_EQ(parameters.prior_mean().head<3>(), Eigen::Vector3d(17, 12, 12));
  MatrixXd expected(4, 4);
  expected << 0.25, -0.1, -0.1, 0,  //
      -0.1, 0.5 + 0.09, 0.5, 0,     // parts of one whole know its value together
      -0.1, 0.5, 0.5 + 0.16, 0, 0, 0, 0, 0.09;
  EXPECT_LT((parameters.prior_covariance() - expected).norm(), 1e-14);
  EXPECT_LT((parameters.prior_variances() - expected.diagonal()).norm(), 1e-14);
}

TEST_F(Inherited, WhatDoesNotFitIsNamed) {
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  expect("    b: {of: [solid.b.stiffness], part_of: other, deviation: 1}\n" + prior, "has no parameter other; it has");
  expect("    b: {of: [solid.b.stiffness], part_of: a}\n" + prior, "deviation: must be given: how far a part");
  expect("    b: {of: [solid.b.stiffness], part_of: a, deviation: 1}\n",
         "part_of: a: is of an earlier identification: give its estimate.json");
  expect("    a: {of: [solid.a.stiffness], mean: 3}\n" + prior, "mean: must be absent");
  expect("    a: {of: [solid.a.stiffness], transform: log, deviation: 1}\n" + prior, "was the log2 of one in");
  expect("    a: {of: [solid.a.stiffness], upper: 1e5}\n" + prior, "is not between the bounds");
  expect("    a: {of: [solid.a.stiffness]}\n  prior_from: watched.json\n", "corrected nothing");
  expect("    nu: {of: [solid.poisson], transform: linear, deviation: 0.1}\n" + prior,
         "prior_from: has none of these parameters; it has a, rest");
}

TEST_F(Inherited, FromWhatIsNoEstimateAreRefusedByValidate) {
  const auto refused = [&](const std::string& prior_from) {
    CommandLine command;
    command.case_file = folder / "case.yaml";
    std::ofstream(command.case_file)
        << "name: test\nunits: cgs\ntime: {step: 0.1, end: 1}\nmesh: {source: swept, swept: {radius: 2, length: 6, "
           "wall_thickness: 0.2, around: 12, along: 6, regions: {rest: {}}}}\nidentification:\n  parameters: {a: {of: "
           "[solid.a.stiffness]}}\n  prior_from: "
        << prior_from << "\n";
    try {
      identification_master_program().validate(command);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  std::ofstream(folder / "flow.csv") << "time, flow\n0, 1\n";
  fs::create_directories(folder / "out");
  std::ofstream(folder / "foreign.json") << "{}\n";
  EXPECT_NE(refused("flow.csv").find("flow.csv: "), std::string::npos) << refused("flow.csv");
  EXPECT_NE(refused("out").find("out: "), std::string::npos) << refused("out");
  EXPECT_NE(refused("foreign.json").find("foreign.json: "), std::string::npos) << refused("foreign.json");
  EXPECT_NE(refused("watched.json").find("corrected nothing"), std::string::npos) << refused("watched.json");
  for (const std::string name : {"negative.json", "impossible.json", "lopsided.json"})
    EXPECT_NE(refused(name).find(name + ": covariance_of_theta is no covariance"), std::string::npos) << refused(name);
  EXPECT_NE(refused("empty.json").find("the estimate of rest has no theta"), std::string::npos);
  EXPECT_NE(refused("estimate.json").find("names no measurements"), std::string::npos) << "it goes on to the data";
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
  expect("    a: {of: []}\n", "of: must name at least one number");
  expect("    a: {of: [solid.a.stiffness], upper: 2e5, mean: 3e5}\n",
         "mean: 300000 is not between the bounds 0 and 200000");
  expect("    a: {of: [solid.a.stiffness], lower: 2e5}\n",
         "100000 is not between the bounds 200000 and inf (the case's");
  expect("    nu: {of: [solid.poisson], transform: linear, mean: 0.7}\n",
         "mean: 0.7 is not between the bounds 0 and 0.5");
  expect("    a: {of: [solid.a.stiffness], transform: linear, mean: -1e5, deviation: 1}\n",
         "mean: -100000 is not between");
  expect("    nu: {of: [solid.poisson], lower: 0.6}\n", "lower: the model admits 0 to 0.5 only");
  expect("    n: {of: [solid.none.stiffness], factor: true}\n", "stays 0 whatever the factor");
  expect("    a: {of: [solid.a.stiffness], deviation: 1e-25}\n", "deviation: 1e-25 of the log2 is too small");
  expect("    a: {of: [solid.a.stiffness], deviation: 1e-10}\n", "must be at least 1.66e-08");
  expect("    shift: {of: [fluid.shift], deviation: 1e-300}\n", "deviation: 1e-300: is too near to zero");
  expect("    a: {of: [solid.a.stiffness], walk: 1e18}\n", "walk: 1e+18 is too large: must be at most 2e+03");
  expect("    a: {of: [solid.a.stiffness], walk: 1000}\n", "walk: 1000 of the log2 is too large: two deviations from");
  expect("    a: {of: [solid.a.stiffness], deviation: 1000}\n", "deviation: 1000 of the log2 is too large");
  EXPECT_NE(refusal("    a: {of: [solid.a.stiffness]}\n    b: {of: [solid.a.stiffness]}\n").find("already set by a"),
            std::string::npos);
}

TEST_F(Parameters, NamesThatTablesAndPlotsCannotCarryAreRefused) {
  const auto expect = [&](const std::string& text, const std::string& part) {
    const std::string told = refusal(text);
    EXPECT_NE(told.find(part), std::string::npos) << told;
    EXPECT_NE(told.find("case.yaml:"), std::string::npos) << told;
  };
  for (const char* name : {"'a\"b'", "'a,b'", "'a`b'", "'a[b]'"})
    expect(fmt::format("    {}: {{of: [solid.a.stiffness]}}\n", name), "a name consists of");
  expect("    a: {of: [solid.a.stiffness]}\n    a.lower: {of: [solid.b.stiffness]}\n",
         "identification.parameters.a.lower: a name in a case has no dot");
  expect("    time: {of: [solid.a.stiffness]}\n", "two columns");
  EXPECT_EQ(refusal("    left spine+k_1: {of: [solid.a.stiffness]}\n"), "accepted");
}

}  // namespace
}  // namespace tether
