// A sudden constant flow Q into a Windkessel: P(t) = P_inf + (P_0 - P_inf) exp(-t / (R_d C)), P_inf = P_distal + R_d Q.
#include <gtest/gtest.h>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

constexpr double R_p = 3, R_d = 40, C = 0.01, P_0 = 5, P_distal = 2, Q = 1, end = 0.4;  // R_d C = 0.4

double exact(double t) {
  return P_distal + R_d * Q + (P_0 - P_distal - R_d * Q) * std::exp(-t / (R_d * C));
}

double step_response_error(int steps) {
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.outlets["outlet"].effect = {"windkessel",
                                     {{"proximal_resistance", R_p},
                                      {"distal_resistance", R_d},
                                      {"compliance", C},
                                      {"initial_pressure", P_0},
                                      {"distal_pressure", P_distal}}};
  FluidSolver solver(box_vessel({1, 1, 1}, {2, 2, 2}), chosen);
  run_rigid(solver, end / steps, steps);
  EXPECT_NEAR(observed(solver, "outlet.flow"), Q, 1e-11);
  EXPECT_NEAR(observed(solver, "outlet.pressure"), observed(solver, "outlet.windkessel_pressure") + R_p * Q, 1e-9);
  return std::abs(observed(solver, "outlet.windkessel_pressure") - exact(end));
}

TEST(Windkessel, StepResponseIsOfFirstOrder) {
  const double coarse = step_response_error(50), fine = step_response_error(100);
  report("windkessel", coarse, fine);
  EXPECT_NEAR(order(coarse, fine), 1, 0.05);
  EXPECT_LT(fine, 0.005 * exact(end));
}

TEST(Windkessel, StiffOnesStayStableAtAnyStep) {
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.outlets["outlet"].effect = {"windkessel",
                                     {{"proximal_resistance", 1e5}, {"distal_resistance", 1e7}, {"compliance", 1e-9}}};
  FluidSolver solver(box_vessel({1, 1, 1}, {2, 2, 2}), chosen);
  run_rigid(solver, 1e-4, 200);
  EXPECT_NEAR(observed(solver, "outlet.flow"), 1, 1e-8);
  EXPECT_NEAR(observed(solver, "outlet.windkessel_pressure"), 1e7 * (1 - std::pow(1 + 1e-4 / 1e-2, -200)), 1);
}

/// A box whose top is an outlet on the left, one on the right, and a strip of wall between them.
FluidMesh box_with_two_outlets() {
  FluidMesh mesh = box_vessel({1, 1, 1}, {5, 4, 4});
  const std::vector<Triangle> top = mesh.outlets.front().triangles;
  mesh.outlets = {{"left", {}}, {"right", {}}};
  for (const Triangle& t : top) {
    const double x = (mesh.points.col(t[0]) + mesh.points.col(t[1]) + mesh.points.col(t[2])).x() / 3;
    (x < 0.4 ? mesh.outlets[0].triangles : x > 0.6 ? mesh.outlets[1].triangles : mesh.interface).push_back(t);
  }
  return mesh;
}

/// Where the resistances are large against the vessel's own, outlets share the flow as their inverses.
TEST(Openings, OutletsShareTheFlowAsTheirResistancesSay) {
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.outlets.clear();
  chosen.outlets["left"].effect = {"resistance", {{"resistance", 1e4}}};
  chosen.outlets["right"].effect = {"resistance", {{"resistance", 3e4}}};
  FluidSolver solver(box_with_two_outlets(), chosen);
  run_rigid(solver, 0.1, 50);
  const double left = observed(solver, "left.flow"), right = observed(solver, "right.flow");
  EXPECT_NEAR(left + right, 1, 1e-11);
  EXPECT_NEAR(left / right, 3, 3e-3);
  EXPECT_NEAR(observed(solver, "left.pressure"), 1e4 * left, 1e-7);
  EXPECT_NEAR(observed(solver, "right.pressure"), 3e4 * right, 1e-7);
}

/// A pressure inlet drives what the resistance lets through.
TEST(Openings, PressureDrivesFlowThroughAResistance) {
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.inlets["inlet"] = {{"pressure", {{"offset", 60}, {"scale", 2}}}, Curve::constant(20)};
  chosen.outlets["outlet"].effect = {"resistance", {{"resistance", 1e4}, {"distal_pressure", 20}}};
  FluidSolver solver(box_vessel({1, 1, 1}, {3, 3, 3}), chosen);
  run_rigid(solver, 0.1, 50);
  EXPECT_NEAR(observed(solver, "inlet.pressure"), 100, 1e-10);
  EXPECT_NEAR(observed(solver, "outlet.flow"), (100 - 20) / 1e4, 1e-3 * 80 / 1e4);
  EXPECT_NEAR(observed(solver, "inlet.flow"), observed(solver, "outlet.flow"), 1e-12);
  EXPECT_NEAR(observed(solver, "outlet.pressure"), 20 + 1e4 * observed(solver, "outlet.flow"), 1e-9);
}

}  // namespace
}  // namespace tether::fluid::testing
