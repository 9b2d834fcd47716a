// Flow and mean pressure through planes across the blood.
#include "fluid/section.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.hpp"
#include "tests/config/case_text.hpp"
#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace section_test {

constexpr double pi = std::numbers::pi;

double area(const SectionCut& cut) {
  double sum = 0;
  for (const CutElement& c : cut.elements) sum += c.area;
  return sum;
}

/// Of the nodal values a + slope.x.
VectorXd linear(const FluidMesh& mesh, double a, const Vec3& slope) {
  return (slope.transpose() * mesh.points).transpose().array() + a;
}

TEST(Section, CutsAStraightTubeExactly) {
  const FluidMesh mesh = tube(1, 3, 16, 9);
  const FluidDomain domain(mesh, MeshMotionKind::harmonic);
  const double across = domain.outlets[0].area();
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -2), Vec3(0.3, -0.2, 1), Vec3(1, 1, -2)})
    for (const double z : {1.0, 1.5, 1.6180339}) {  // the first among nodes: nine intervals of a third
      const Vec3 point(0, 0, z);
      const Section section = place_section("middle", {point, normal}, mesh);
      const SectionCut cut = section.cut(mesh, mesh.points);
      EXPECT_TRUE(cut.is_complete);
      EXPECT_NEAR(area(cut), across / std::abs(section.normal().z()), 1e-12);
      const Vec3 slope(3, -2, 7);
      EXPECT_NEAR(Section::mean(cut, mesh, linear(mesh, 5, slope)), 5 + slope.dot(point), 1e-12)
          << "it is symmetric about the point";
    }
}

TEST(Section, ARadiusLeavesADisc) {
  const FluidMesh mesh = tube(1, 3, 16, 9);
  const FluidDomain domain(mesh, MeshMotionKind::harmonic);
  const Vec3 point(0.2, -0.1, 1.4), normal(0.2, 0, 1), slope(3, -2, 7);
  const Section section = place_section("disc", {point, normal, 0.5}, mesh);
  const SectionCut cut = section.cut(mesh, mesh.points);
  EXPECT_FALSE(cut.is_complete);
  EXPECT_NEAR(area(cut), pi * 0.25, 1e-12);
  const VectorXd field = linear(mesh, 5, slope), none = VectorXd::Zero(field.size());
  EXPECT_NEAR(Section::mean(cut, mesh, field), 5 + slope.dot(point), 1e-12);
  const Vec3 direction(0.5, 1, -2);
  const Points velocity = direction * field.transpose();
  EXPECT_NEAR(section.flow(cut, {domain, mesh.points, velocity, none, 1, {}}),
              pi * 0.25 * (5 + slope.dot(point)) * direction.dot(section.normal()), 1e-11);
  EXPECT_TRUE(place_section("wide", {point, normal, 1.5}, mesh).cut(mesh, mesh.points).is_complete);
}

FluidSettings with_sections(std::vector<std::pair<std::string, SectionPlane>> sections) {
  FluidSettings result = settings(1, 0.5);
  result.sections = std::move(sections);
  return result;
}

/// A tube of radius 1 at its ends and 0.7 in the middle.
FluidMesh narrowed_tube(int around) {
  FluidMesh mesh = tube(1, 3, around, 3 * around / 8);
  for (auto x : mesh.points.colwise()) x.head<2>() *= 1 - 0.15 * (1 - std::cos(2 * pi / 3 * x.z()));
  return mesh;
}

const Vec3 oblique(0.5, 0.2, 1);

/// Of steady flow Q = 1: the largest error of flow(section), over all steps too, and the root mean square of that of
/// int v.n over oblique sections.
struct SteadyErrors {
  double flow = 0, integral = 0;
};
SteadyErrors steady_flow(FluidMesh mesh) {
  constexpr double dt = 0.04;
  const std::vector<double> places{0.65, 0.9, 1.03, 1.25, 1.5, 1.7, 2.02, 2.3};
  FluidSettings chosen = with_sections({{"across", {{0, 0, 1.5}, {0, 0, 1}}}, {"back", {{0, 0, 2.1}, {0, 0, -1}}}});
  for (const double z : places)
    chosen.sections.emplace_back(fmt::format("oblique_{}", z), SectionPlane{{0, 0, z}, oblique});
  FluidSolver solver(std::move(mesh), chosen);
  SteadyErrors errors;
  const auto add = [&](const std::string& name, double flow) {
    errors.flow = std::max(errors.flow, std::abs(observed(solver, name + ".flow") - flow));
  };
  for (int n = 0; n < 40; ++n) {
    run_rigid(solver, dt, 1, n * dt);
    add("across", 1), add("back", -1);
    for (const double z : places) add(fmt::format("oblique_{}", z), 1);
  }
  const FluidDomain& domain = solver.domain();
  for (const double z : places) {
    const Section section("oblique", {{0, 0, z}, oblique});
    const SectionCut cut = section.cut(domain.mesh(), domain.mesh().points);
    const double flow =
        section.integral_of_velocity(cut, {domain, domain.mesh().points, solver.velocity(), solver.pressure(), dt, {}});
    errors.integral += std::pow(flow - 1, 2) / static_cast<double>(places.size());
    EXPECT_NEAR(observed(solver, fmt::format("oblique_{}.pressure", z)),
                Section::mean(cut, domain.mesh(), solver.pressure()), 1e-11);
  }
  errors.integral = std::sqrt(errors.integral);
  return errors;
}

TEST(Section, HasTheInletsFlowToRoundOff) {
  const SteadyErrors straight = steady_flow(tube(1, 3, 16, 6));
  std::printf("| straight tube: flow %.1e, integral of velocity %.1e |\n", straight.flow, straight.integral);
  EXPECT_LT(straight.flow, 1e-11);
  EXPECT_LT(straight.integral, 1e-2);
}

TEST(Section, IntegralOfTheVelocityConvergesToItsFlow) {
  const SteadyErrors coarse = steady_flow(narrowed_tube(16)), fine = steady_flow(narrowed_tube(32));
  report("section_integral_of_velocity", coarse.integral, fine.integral);
  EXPECT_LT(std::max(coarse.flow, fine.flow), 1e-11);
  EXPECT_GT(order(coarse.integral, fine.integral), 1.5);
}

/// Volume of the blood beyond a plane: in an element with different heights h_a of its nodes, the share
/// sum over h_a > 0 of h_a^3 / prod_b (h_a - h_b).
double volume_beyond(const FluidDomain& domain, const Points& points, const SectionPlane& plane) {
  double volume = 0;
  for (const Tetrahedron& tet : domain.tetrahedra()) {
    const Nodal corners = gather(points, tet);
    const Eigen::Vector4d h = (corners.colwise() - plane.point).transpose() * plane.normal.normalized();
    double share = (h.array() > 0).all() ? 1 : 0;
    if (share == 0)
      for (int a = 0; a < 4; ++a) {
        double product = 1;
        for (int b = 0; b < 4; ++b)
          if (b != a) product *= h[a] - h[b];
        if (h[a] > 0) share += std::pow(h[a], 3) / product;
      }
    volume += share * tet_geometry(corners).volume;
  }
  return volume;
}

/// From 1 at the middle of 0 < z < 1.4 to zero at its ends, and beyond.
double hump(double z) {
  return z < 1.4 ? std::pow(std::sin(pi * z / 1.4), 2) : 0;
}

/// flow(section) - flow(outlet) against the rate of volume between them, the largest difference over half a second.
/// The wall breathes and sways between ends that stand still; beyond the section "quiet" all of it does.
double balance_error(double dt, double* largest_rate = nullptr) {
  const SectionPlane plane{{0.1, 0, 0.9}, {0.313, 0.171, 1}};
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.sections = {{"middle", plane}, {"quiet", {{0, 0, 1.8}, {0.05, 0, 1}}}};
  FluidSolver solver(tube(1, 2, 12, 6), chosen);
  const FluidDomain& domain = solver.domain();
  const Points on_sigma = domain.sigma.local(domain.mesh().points);
  const auto motion = [&](double t) {
    Points result = on_sigma;
    for (auto x : result.colwise()) {
      const double far = hump(x.z()), grow = 0.1 * std::sin(3 * t) * far;
      x = Vec3(grow * x.x() + 0.05 * far * std::sin(2 * t), grow * x.y(), 0.05 * far * std::sin(4 * t));
    }
    return result;
  };
  Points y0 = zero_on_sigma(solver), y_before = y0;
  double volume = volume_beyond(domain, domain.mesh().points, plane), error = 0;
  for (int n = 0; n < std::lround(0.5 / dt); ++n) {
    const Points y1 = motion((n + 1) * dt);
    solver.begin_step(n * dt, dt, 2 * y0 - y_before);
    solver.evaluate(y1, (y1 - y0) / dt);
    solver.accept();
    y_before = y0;
    y0 = y1;
    const double next = volume_beyond(domain, domain.mesh().points + domain.extend(y1), plane),
                 rate = (next - volume) / dt;
    volume = next;
    EXPECT_NEAR(observed(solver, "quiet.flow"), observed(solver, "outlet.flow"), 1e-11);
    if (n <= 2) continue;
    error = std::max(error, std::abs(observed(solver, "middle.flow") - observed(solver, "outlet.flow") - rate));
    if (largest_rate != nullptr) *largest_rate = std::max(*largest_rate, std::abs(rate));
  }
  return error;
}

TEST(Section, BesideAMovingWallKeepsTheVolumeToFirstOrder) {
  double rate = 0;
  const double coarse = balance_error(0.01, &rate), fine = balance_error(0.005), finest = balance_error(0.0025);
  report("section_volume_balance", coarse, fine);
  report("section_volume_balance", fine, finest);
  std::printf("| largest rate of the volume beyond the section | %.3g |\n", rate);
  EXPECT_NEAR(order(fine, finest), 1, 0.2);
  EXPECT_LT(finest, 0.02 * rate);
}

/// Two tubes side by side, of the flows 1 and 5.
TEST(Section, CountsOnlyThePartThatHoldsItsPoint) {
  FluidMesh mesh = tube(1, 2, 12, 6);
  FluidMesh other = mesh;
  const auto nodes = static_cast<int>(mesh.points.cols());
  const auto renumbered = [nodes](auto cells) {
    for (auto& cell : cells)
      for (int& node : cell) node += nodes;
    return cells;
  };
  mesh.points.conservativeResize(3, 2 * nodes);
  mesh.points.rightCols(nodes) = other.points.colwise() + Vec3(3, 0, 0);
  for (const auto& tet : renumbered(other.tetrahedra)) mesh.tetrahedra.push_back(tet);
  for (const auto& triangle : renumbered(other.interface)) mesh.interface.push_back(triangle);
  mesh.inlets.push_back({"other_inlet", renumbered(other.inlets[0].triangles)});
  mesh.outlets.push_back({"other_outlet", renumbered(other.outlets[0].triangles)});
  const Vec3 normal(0.1, 0, 1);
  FluidSettings chosen = with_sections({{"left", {{-0.9, 0, 1}, normal}}, {"right", {{2.2, 0.1, 0.7}, normal}}});
  chosen.inlets["other_inlet"].curve = Curve::constant(5);
  chosen.outlets["other_outlet"] = chosen.outlets.at("outlet");
  FluidSolver solver(mesh, chosen);
  run_rigid(solver, 0.01, 2);
  EXPECT_NEAR(observed(solver, "left.flow"), 1, 1e-11);
  EXPECT_NEAR(observed(solver, "right.flow"), 5, 1e-11);
}

TEST(Section, ThatDoesNotCrossTheBloodIsAnError) {
  const FluidMesh mesh = tube(1, 2, 12, 6);
  const auto message = [&](const SectionPlane& plane) {
    return input_error_of([&] { place_section("here", plane, mesh); });
  };
  EXPECT_EQ(message({{0, 0, 1}, {0, 0, 1}}), "no error");
  EXPECT_EQ(message({{0, 0, 2.5}, {0, 0, 1}}), "its plane misses the lumen");
  EXPECT_EQ(message({{0, 1.5, 1}, {0, 0, 1}}), "(0, 1.5, 1) lies outside the blood, 0.5 from its surface");
  EXPECT_NE(message({{0, 0, 1.9}, {1, 0, 1}}).find("leaves the lumen through outlet"), std::string::npos);
  EXPECT_NE(message({{0, 0, 1}, {1, 0, 0}}).find("leaves the lumen through inlet"), std::string::npos);
  EXPECT_EQ(message({{0, 0, 1.9}, {1, 0, 1}, 0.05}), "no error");
  EXPECT_EQ(message({{0, 0, 1}, {0, 0, 0}}), "the normal must not be zero");
}

TEST(Section, EndsTheRunWhereTheBloodMovesAwayFromIt) {
  FluidSolver solver(tube(1, 2, 12, 6), with_sections({{"low", {{0, 0, 0.2}, {0, 0, 1}}}}));
  const auto nodes = zero_on_sigma(solver).cols();
  const Points shift = Vec3(0, 0, 0.5).replicate(1, nodes);
  const VectorXd before = solver.state();
  try {
    solver.begin_step(0, 0.01, shift);
    FAIL() << "no error, and the step would be accepted by the wall";
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "the blood has moved away from the section low: its plane misses the lumen");
  }
  EXPECT_EQ(solver.state(), before);
}

}  // namespace section_test
}  // namespace tether::fluid::testing
