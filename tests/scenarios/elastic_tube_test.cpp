#include <fmt/format.h>

#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"
#include "tests/scenarios/elastic_tube.hpp"

/// Womersley's elastic tube: a harmonic pressure enters, the outlet swallows the wave. Propagation, wall motion and
/// velocity profile at three stations against the closed form.
namespace tether {
namespace elastic_tube_test {

using testing::Complex;

// Tethered along itself by the tissue: the clamped ends do not pull at the wall between them.
constexpr testing::ElasticTube tube{
    .a = 1, .h = 0.1, .E = 1e6, .nu = 0.3, .rho_s = 1.2, .rho = 1, .mu = 1.9635, .tether = 2e4};
constexpr double period = 0.2, omega = 2 * std::numbers::pi / period, amplitude = 10, length = 16, spacing = 4;
constexpr int periods = 3;

std::string case_text(int around, int steps_per_period) {
  const Complex k = tube.wave_number(omega);
  const double resistance = tube.rho * (omega / k).real() / (std::numbers::pi * tube.a * tube.a);
  return fmt::format(R"(name: elastic_tube
units: cgs
time: {{step: {}, end: {}}}
mesh: {{source: swept, swept: {{radius: {}, length: {}, wall_thickness: {}, around: {}, along: {}, layers: 1}}}}
fluid:
  density: {}
  rheology: {{type: newtonian, viscosity: {}}}
  inlets: {{inlet: {{type: pressure, pressure: {{file: wave.csv, time: time, value: pressure, period: {}}}}}}}
  outlets: {{outlet: {{type: resistance, resistance: {}}}}}
solid:
  density: {}
  material: {{type: saint_venant_kirchhoff, young: {}, poisson: {}}}
  support: {{regions: {{wall: {{type: tangential_visco_elastic, stiffness: {}}}}}}}
)",
                     period / steps_per_period, periods * period, tube.a, length, tube.h, around, 4 * around / 3,
                     tube.rho, tube.mu, period, resistance, tube.rho_s, tube.E, tube.nu, tube.tether);
}

std::string wave_table() {
  std::string text = "time [s], pressure [dyn/cm2]\n";
  for (int i = 0; i <= 1000; ++i)
    text += fmt::format("{}, {}\n", i * period / 1000, amplitude * std::sin(2 * std::numbers::pi * i / 1000));
  return text;
}

/// Amplitudes of exp(i omega t) in the last period, at the nodes of the blood and of the interface.
struct Harmonic {
  Points nodes, wall_nodes;
  Eigen::VectorXcd pressure, axial_velocity, radial_displacement;
};

Harmonic run(const std::filesystem::path& case_file) {
  CoupledVessel vessel(case_file);
  const int steps = vessel.steps_of_case();
  const fluid::FluidSolver& blood = vessel.blood();
  Harmonic sum{blood.domain().mesh().points, vessel.reference(), {}, {}, {}};
  sum.pressure = sum.axial_velocity = Eigen::VectorXcd::Zero(sum.nodes.cols());
  sum.radial_displacement = Eigen::VectorXcd::Zero(sum.wall_nodes.cols());
  const Points outward = sum.wall_nodes.array().colwise() * Eigen::Array3d(1, 1, 0) / tube.a;
  for (int n = 1; n <= steps; ++n) {
    vessel.advance();
    if (n <= steps - steps / periods) continue;
    const Complex factor = std::polar(2.0 * periods / steps, -omega * vessel.time());
    sum.pressure += factor * blood.pressure();
    sum.axial_velocity += factor * blood.velocity().row(2).transpose();
    sum.radial_displacement += factor * vessel.displacement().cwiseProduct(outward).colwise().sum().transpose();
  }
  return sum;
}

/// Mean of a field over the nodes at this height, from radius r_min on.
Complex mean_at(double z, double r_min, const Points& nodes, const Eigen::VectorXcd& field, double r_max = 10) {
  Complex sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const double r = nodes.col(i).head<2>().norm();
    if (std::abs(nodes(2, i) - z) > 1e-6 || r < r_min || r > r_max) continue;
    sum += field[i];
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// Relative errors of the wave against the closed form.
struct Errors {
  double speed, damping, wall_motion, profile;
};

Errors errors(const Harmonic& wave, double dt) {
  const Complex exact = tube.wave_number(omega), i(0, 1);
  const auto on_axis = [&](double z) { return mean_at(z, 0, wave.nodes, wave.pressure, 1e-6); };
  const double middle = length / 2;
  const Complex before = on_axis(middle - spacing), here = on_axis(middle), behind = on_axis(middle + spacing);
  const Complex k = std::acos((before + behind) / (2.0 * here)) / spacing;  // whatever is reflected
  const Complex gradient = (before - behind) / (2 * spacing) * k * spacing / std::sin(k * spacing);
  const Complex on_wall = mean_at(middle, 0.999 * tube.a, wave.nodes, wave.pressure),
                motion = mean_at(middle, 0, wave.wall_nodes, wave.radial_displacement);
  double difference = 0, size = 0;
  for (Eigen::Index n = 0; n < wave.nodes.cols(); ++n) {
    if (std::abs(wave.nodes(2, n) - middle) > 1e-6) continue;
    const double r = wave.nodes.col(n).head<2>().norm();
    if (r > 0.999 * tube.a) continue;
    const Complex v = tube.velocity(r, exact, omega) / (i * exact) * gradient;
    difference += std::norm(wave.axial_velocity[n] + dt / tube.rho * gradient - v);  // (F.3)
    size += std::norm(v);
  }
  return {std::abs(exact.real() / k.real() - 1), std::abs(k.imag() / exact.imag() - 1),
          std::abs(motion / on_wall / tube.radial(exact, omega) - 1.0), std::sqrt(difference / size)};
}

TEST(ElasticTube, CarriesWomersleysWave) {
  const TemporaryFolder folder;
  folder.file("wave.csv", wave_table());
  const auto measured = [&](int around, int steps_per_period) {
    return errors(run(folder.file("case.yaml", case_text(around, steps_per_period))), period / steps_per_period);
  };
  const Errors coarse = measured(12, 64), fine = measured(18, 144);
  const auto expect_order = [&](const char* what, double Errors::*error, double least) {
    const double order = std::log(coarse.*error / fine.*error) / std::log(1.5);
    std::printf("| %s | %.3g | %.3g | %.2f |\n", what, coarse.*error, fine.*error, order);
    EXPECT_GE(order, least) << what;
  };
  const Complex k = tube.wave_number(omega);
  std::printf("c = %.2f cm/s (Moens-Korteweg %.2f, thick wall %.2f), damping %.4g per cm\n", omega / k.real(),
              tube.moens_korteweg(), tube.long_wave_speed(), -k.imag());
  expect_order("speed", &Errors::speed, 1.7);
  expect_order("damping", &Errors::damping, 1.5);
  expect_order("wall motion over pressure", &Errors::wall_motion, 1.7);
  expect_order("velocity profile", &Errors::profile, 1);  // the end-of-step velocity slips: sqrt(nu dt) at the wall
  EXPECT_LE(fine.speed, 0.02);
}

}  // namespace elastic_tube_test
}  // namespace tether
