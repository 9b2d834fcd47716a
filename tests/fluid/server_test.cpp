// The program's two doors: the case file and the messages.
#include "fluid/server.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fluid/case.hpp"
#include "tests/config/case_text.hpp"
#include "tests/fluid/fluid_testing.hpp"
#include "tests/protocol/in_process.hpp"

namespace tether::fluid::testing {
namespace {

const std::string valid_fluid =
    "fluid:\n"
    "  density: 1.06\n"
    "  rheology: {type: newtonian, viscosity: 0.04}\n"
    "  inlets: {inlet: {profile: parabolic, flow: {constant: 80 ml/s}}}\n"
    "  outlets: {outlet: {type: resistance, resistance: 100}}\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error(from);
  return text.replace(at, from.size(), to);
}

/// Reads the case and builds the solver's settings, as the program does. Returns the error's message.
std::string read(const std::string& text, FluidSettings* result = nullptr) {
  const auto path = write_file("case.yaml", valid_head + text);
  return input_error_of([&] {
    CaseFile file(path);
    FluidCase fluid;
    file.read("fluid", fluid);
    file.finish();
    check_against_mesh(fluid, box_vessel({1, 1, 1}, {2, 2, 2}), file);
    const FluidSettings settings = make_settings(fluid, file);
    if (result != nullptr) *result = settings;
  });
}

TEST(FluidCase, BecomesSettingsInTheCasesUnits) {
  FluidSettings settings;
  ASSERT_EQ(read(valid_fluid, &settings), "no error");
  EXPECT_DOUBLE_EQ(settings.inlets.at("inlet").curve(0.3), 80);
  EXPECT_EQ(settings.outlets.at("outlet").effect.values.at("resistance"), 100);
  EXPECT_EQ(settings.blood.values.at("wall_load_offset"), 0);
  FluidSolver solver(box_vessel({1, 1, 1}, {2, 2, 2}), settings);
  run_rigid(solver, 0.01, 1);
  EXPECT_NEAR(observed(solver, "outlet.flow"), 80, 1e-10);
}

/// The run of the valid head ends at 0.9.
TEST(FluidCase, ATableThatEndsBeforeTheRunIsTold) {
  write_file("q.csv", "time [s], value [ml/s]\n0, 80\n0.05, 90\n");
  const auto told = [](const std::string& more) {
    CaseFile file(write_file("case.yaml",
                             valid_head + replaced(valid_fluid, "{constant: 80 ml/s}", "{file: q.csv" + more + "}")));
    FluidCase fluid;
    file.read("fluid", fluid);
    file.finish();
    return held_curves(fluid, file);
  };
  EXPECT_EQ(told(""), std::vector<std::string>{"inlet: q.csv ends at 0.05 s, the run at 0.9 s: its last value is held "
                                               "until then; does it repeat (period)?"});
  EXPECT_TRUE(told(", period: 0.05").empty());
  write_file("q.csv", "time [s], value [ml/s]\n0, 80\n0.9, 90\n");
  EXPECT_TRUE(told("").empty());
}

TEST(FluidCase, APrestressedWallBearsTheImagesPressure) {
  FluidSettings settings;
  ASSERT_EQ(read("image: {pressure: 80 mmHg, wall: prestressed}\n" + valid_fluid, &settings), "no error");
  EXPECT_NEAR(settings.blood.values.at("wall_load_offset"), 106657.6, 1);
}

TEST(FluidCase, MistakesAreNamedWithTheirPlace) {
  const auto wrong = [](const std::string& from, const std::string& to) {
    return read(replaced(valid_fluid, from, to));
  };
  const auto expect = [](const std::string& message, std::initializer_list<const char*> parts) {
    for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
  };
  expect(wrong("density: 1.06", "density: -1"), {"case.yaml:7", "density", "-1", "positive"});
  expect(wrong("viscosity: 0.04", "viscosty: 0.04"), {"case.yaml:8", "viscosty", "viscosity"});
  expect(wrong("newtonian", "honey"), {"case.yaml:8", "honey", "newtonian", "casson"});
  expect(wrong("{constant: 80 ml/s}", "{constant: 80 mmHg}"), {"case.yaml:9", "80 mmHg"});
  expect(wrong("{constant: 80 ml/s}", "{}"), {"case.yaml:9", "file or a constant"});
  expect(wrong("parabolic", "womersley"), {"case.yaml:9", "womersley", "period"});
  expect(wrong("{outlet: {type: resistance, resistance: 100}}", "{exit: {type: resistance, resistance: 100}}"),
         {"case.yaml:10", "outlet"});
  expect(wrong("type: resistance, resistance: 100", "type: windkessel, proximal_resistance: 1"),
         {"case.yaml:10", "distal_resistance", "must be given"});
  expect(read(valid_fluid + "  probes: {middle: [0.5, 0.5, 0.5], beside: [1.25, 0.5, 0.5]}\n"),
         {"case.yaml:11", "fluid.probes.beside", "(1.25, 0.5, 0.5)", "0.25 from its surface"});
  expect(read(valid_fluid + "  probes: {outlet: [0.5, 0.5, 0.5]}\n"), {"case.yaml:11", "fluid.probes.outlet", "own"});
  const auto section = [&](const std::string& text) { return read(valid_fluid + "  sections: {" + text + "}\n"); };
  EXPECT_EQ(section("middle: {point: [0.5, 0.5, 0.5], normal: [0, 0, 1]}"), "no error");
  expect(section("high: {point: [0.5, 0.5, 1.5], normal: [0, 0, 1]}"),
         {"case.yaml:11", "fluid.sections.high", "misses the lumen"});
  expect(section("beside: {point: [1.25, 0.5, 0.5], normal: [0, 0, 1]}"),
         {"case.yaml:11", "fluid.sections.beside", "0.25 from its surface"});
  expect(section("along: {point: [0.5, 0.5, 0.5], normal: [1, 0, 0]}"),
         {"case.yaml:11", "fluid.sections.along", "leaves the lumen through inlet"});
  expect(section("flat: {point: [0.5, 0.5, 0.5], normal: [0, 0, 0]}"),
         {"case.yaml:11", "fluid.sections.flat.normal", "must not be zero"});
  expect(section("half: {point: [0.5, 0.5, 0.5]}"), {"case.yaml:11", "fluid.sections.half.normal", "must be given"});
  expect(section("outlet: {point: [0.5, 0.5, 0.5], normal: [0, 0, 1]}"),
         {"case.yaml:11", "fluid.sections.outlet", "own"});
  expect(section("a: {point: [0.5, 0.5, 0.5], normal: [0, 0, 1]}}\n  probes: {a: [0.5, 0.5, 0.5]"),
         {"case.yaml:11", "fluid.sections.a", "probe"});
}

FluidServer make_server() {
  return {std::make_unique<FluidSolver>(tube(1, 2, 12, 6), settings(1.06, 0.04)), UnitSystem::cgs(), "{}",
          test_folder()};
}

TEST(FluidServer, SpeaksTheProtocol) {
  auto handler = std::make_shared<FluidServer>(make_server());
  protocol::Partner fluid = protocol::in_process_partner<protocol::ToFluid>("fluid", handler);
  EXPECT_TRUE(fluid.hello().has_tangent);
  EXPECT_EQ(fluid.hello().observables[0].name, "inlet.flow");
  EXPECT_EQ(fluid.hello().observables[0].unit, "cm3/s");

  const auto surface = fluid.ask(protocol::GetInterface{});
  const std::vector<double> zero(surface.points.size(), 0.0);
  fluid.ask(protocol::BeginStep{1, 0, 0.01, zero});
  EXPECT_EQ(fluid.ask(protocol::FluidEvaluate{zero, zero}).forces.size(), zero.size());
  EXPECT_EQ(fluid.ask(protocol::FluidTangent{zero}).forces, zero);
  const auto report = fluid.ask(protocol::EndStep{true});
  EXPECT_EQ(report.observables.size(), fluid.hello().observables.size());
  EXPECT_EQ(report.observables[0], 1);

  const auto state = fluid.ask(protocol::GetState{});
  EXPECT_EQ(static_cast<std::int64_t>(state.values.size()), fluid.hello().state_size);
  fluid.ask(protocol::SetState{state.values});
  EXPECT_EQ(fluid.ask(protocol::GetState{}).values, state.values);
  fluid.ask(protocol::Write{1, 0.01});
  EXPECT_TRUE(std::filesystem::exists(test_folder() / "fluid.pvd"));
}

TEST(FluidServer, TellsTheVelocityWhereItsMeshStands) {
  auto handler = std::make_shared<FluidServer>(make_server());
  protocol::Partner fluid = protocol::in_process_partner<protocol::ToObservedFluid>("fluid", handler);
  const auto surface = fluid.ask(protocol::GetInterface{});
  std::vector<double> wider = surface.points;
  for (std::size_t i = 0; i < wider.size(); ++i) wider[i] *= i % 3 == 2 ? 0 : 0.1;
  std::vector<double> velocity = wider;
  for (double& v : velocity) v /= 0.01;
  fluid.ask(protocol::BeginStep{1, 0, 0.01, wider});
  fluid.ask(protocol::FluidEvaluate{wider, velocity});
  fluid.ask(protocol::EndStep{true});
  const Vec3 beyond(surface.points[0], surface.points[1], 1);  // of the imaged wall: the lumen is wider now
  const double out = 1.05 / beyond.head<2>().norm();
  const auto answer =
      fluid.ask(protocol::GetVelocity{{0, 0, 1, out * beyond[0], out * beyond[1], 1, 2 * beyond[0], 2 * beyond[1], 1}});
  ASSERT_EQ(answer.values.size(), 9U);
  EXPECT_TRUE(std::isfinite(answer.values[2]));
  EXPECT_GT(answer.values[3] * beyond[0] + answer.values[4] * beyond[1], 0) << "the wall moves outward";
  EXPECT_TRUE(std::isnan(answer.values[6]));
  EXPECT_THROW(handler->operator()(protocol::GetVelocity{{0, 0}}), RunError);
}

TEST(FluidServer, AnswersMistakesWithTheirReason) {
  FluidServer server = make_server();
  EXPECT_THROW(server(protocol::BeginStep{1, 0, 0.01, {0, 0}}), RunError);
  EXPECT_THROW(server(protocol::SetParameters{{"fluid.density"}, {}}), InputError);
  EXPECT_THROW(server(protocol::SetParameters{{"fluid.colour"}, {1}}), InputError);
  EXPECT_THROW(server(protocol::SetState{{1, 2, 3}}), InputError);
}

TEST(FluidServer, SetsAllParametersOrNone) {
  FluidServer server = make_server();
  const auto values = [&] {
    std::vector<double> all;
    for (const auto& p : server.hello().parameters) all.push_back(p.value);
    return all;
  };
  const std::vector<double> before = values();
  EXPECT_THROW(server(protocol::SetParameters{{"fluid.density", "fluid.colour"}, {1.2, 1}}), InputError);
  EXPECT_THROW(server(protocol::SetParameters{{"fluid.colour", "fluid.density"}, {1, 1.2}}), InputError);
  EXPECT_THROW(server(protocol::SetParameters{{"fluid.rheology.viscosity", "fluid.density"}, {0.05, -1}}), InputError);
  EXPECT_EQ(values(), before);
  server(protocol::SetParameters{{"fluid.density"}, {1.2}});
  EXPECT_NE(values(), before);
}

/// The triangles' normals point out of the fluid.
TEST(FluidServer, OrientsTheInterfaceOutward) {
  FluidServer server = make_server();
  const auto surface = server(protocol::GetInterface{});
  const auto point = [&](std::int64_t i) { return Vec3(surface.points.data() + 3 * i); };
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const Vec3 a = point(surface.triangles[t]), b = point(surface.triangles[t + 1]),
               c = point(surface.triangles[t + 2]);
    const Vec3 normal = (b - a).cross(c - a), centre = (a + b + c) / 3;
    EXPECT_GT(normal.head<2>().dot(centre.head<2>()), 0);
  }
}

}  // namespace
}  // namespace tether::fluid::testing
