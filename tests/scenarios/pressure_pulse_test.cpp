#include <fmt/format.h>

#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"
#include "tests/scenarios/elastic_tube.hpp"

/// configs/pressure_pulse with a small and smooth pulse: how fast it runs from a quarter to the middle of the tube, by
/// the wall's motion there, against the pulse of linear theory at the same two places.
namespace tether {
namespace pressure_pulse_test {

constexpr testing::ElasticTube tube{.a = 0.5, .h = 0.1, .E = 3e6, .nu = 0.3, .rho_s = 1.2, .rho = 1, .mu = 0.03};
constexpr double pulse_length = 0.01, quarter = 2.5, middle = 5, end = 0.026;

double pulse(double t) {
  const double s = std::sin(std::numbers::pi * t / pulse_length);
  return t < pulse_length ? s * s : 0;
}

std::string pulse_table() {
  std::string text = "time [s], pressure [dyn/cm2]\n";
  for (int i = 0; i <= 1000; ++i) text += fmt::format("{}, {}\n", 1e-5 * i, pulse(1e-5 * i));
  return text + "1, 0\n";
}

/// The wall's radial motion at both places, every `dt`.
struct Traces {
  double dt;
  std::vector<double> quarter, middle;
};

/// Linear between the samples, zero outside.
double value_at(const Traces& traces, const std::vector<double>& values, double t) {
  const double place = t / traces.dt;
  const auto i = static_cast<std::size_t>(std::max(place, 0.0));
  if (place < 0 || i + 1 >= values.size()) return 0.0;
  const double share = place - static_cast<double>(i);
  return (1 - share) * values[i] + share * values[i + 1];
}

double correlation(const Traces& traces, double delay) {
  double sum = 0;
  for (double t = 0; t < end; t += 1e-5)
    sum += value_at(traces, traces.quarter, t) * value_at(traces, traces.middle, t + delay);
  return sum;
}

/// From the delay at which the two motions are most alike.
double speed(const Traces& traces) {
  double best = 0, largest = -1;
  for (double delay = 3e-3; delay < 8e-3; delay += 5e-6)
    if (const double value = correlation(traces, delay); value > largest) {
      largest = value;
      best = delay;
    }
  return (middle - quarter) / best;
}

/// Of the motions at the middle, over the theory's: relative, root of the mean square.
double difference(const Traces& computed, const Traces& theory) {
  double sum = 0, size = 0;
  for (std::size_t n = 0; n < computed.middle.size(); ++n) {
    const double exact = value_at(theory, theory.middle, static_cast<double>(n) * computed.dt);
    sum += std::pow(computed.middle[n] - exact, 2);
    size += exact * exact;
  }
  return std::sqrt(sum / size);
}

/// The pulse of linear theory in a semi-infinite tube: a Fourier series over a window much longer than the run.
Traces theory() {
  constexpr double window = 0.06, dt = 1e-4;
  const auto samples = static_cast<std::size_t>(std::lround(end / dt)) + 1;
  Traces traces{dt, std::vector<double>(samples, 0.0), std::vector<double>(samples, 0.0)};
  testing::Complex k = 0;
  for (int n = 1; n * 1.0 / window < 400; ++n) {
    const double omega = 2 * std::numbers::pi * n / window;
    k = n == 1 ? tube.wave_number(omega) : tube.wave_number(omega, k * static_cast<double>(n) / (n - 1.0));
    const testing::Complex i(0, 1);
    testing::Complex harmonic = 0;
    for (int m = 0; m < 1000; ++m)
      harmonic += 2 / window * pulse_length / 1000 * pulse(pulse_length * m / 1000) *
                  std::exp(-i * omega * (pulse_length * m / 1000));
    for (std::size_t s = 0; s < samples; ++s) {
      const double t = static_cast<double>(s) * dt;
      const auto add = [&](std::vector<double>& values, double z) {
        values[s] += (harmonic * tube.radial(k, omega) * std::exp(i * (omega * t - k * z))).real();
      };
      add(traces.quarter, quarter);
      add(traces.middle, middle);
    }
  }
  for (auto* values : {&traces.quarter, &traces.middle})  // the mean, which the series leaves out
    for (const double start = values->front(); double& value : *values) value -= start;
  return traces;
}

Traces computed(const std::filesystem::path& case_file) {
  CoupledVessel vessel(case_file);
  Traces traces{vessel.dt(), {0}, {0}};
  const auto radial = [&](double z) {
    double sum = 0;
    int count = 0;
    const Points y = vessel.displacement();
    for (Eigen::Index i = 0; i < y.cols(); ++i) {
      const Vec3 x = vessel.reference().col(i);
      if (std::abs(x(2) - z) > 1e-6) continue;
      sum += y.col(i).head<2>().dot(x.head<2>()) / tube.a;
      ++count;
    }
    return sum / count;
  };
  for (int n = 0; n < vessel.steps_of_case(); ++n) {
    vessel.advance();
    traces.quarter.push_back(radial(quarter));
    traces.middle.push_back(radial(middle));
  }
  return traces;
}

TEST(PressurePulse, RunsAtTheSpeedOfTheory) {
  const TemporaryFolder folder;
  folder.file("smooth.csv", pulse_table());
  const auto variant = [&](const char* around, const char* along, const char* step) {
    return computed(case_variant(TETHER_SOURCE "/configs/pressure_pulse/case.yaml", folder / "case",
                                 {{"around: 20", around},
                                  {"along: 80", along},
                                  {"step: 1e-4", step},
                                  {"end: 0.012", "end: 0.026"},
                                  {"file: pulse.csv", "file: ../smooth.csv"}}));
  };
  const Traces exact = theory(), coarse = variant("around: 10", "along: 40", "step: 2e-4"),
               fine = variant("around: 16", "along: 64", "step: 1.25e-4");
  std::printf("theory %.1f cm/s (Moens-Korteweg %.1f, long waves %.1f), computed %.1f and %.1f\n", speed(exact),
              tube.moens_korteweg(), tube.long_wave_speed(), speed(coarse), speed(fine));
  const double coarse_error = difference(coarse, exact), fine_error = difference(fine, exact),
               order = std::log(coarse_error / fine_error) / std::log(1.6);
  std::printf("| wall motion at the middle | %.3g | %.3g | %.2f | 1 |\n", coarse_error, fine_error, order);
  EXPECT_NEAR(speed(coarse), speed(exact), 0.01 * speed(exact));
  EXPECT_NEAR(speed(fine), speed(exact), 0.005 * speed(exact));
  EXPECT_GE(order, 0.8);
}

}  // namespace pressure_pulse_test
}  // namespace tether
