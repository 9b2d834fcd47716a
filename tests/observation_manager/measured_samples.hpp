#pragma once

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "observation_manager/measurements/observations.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observation_manager/lumens.hpp"

/// A run that is easy to foresee, and for each kind of measurement what would be measured of it.
namespace tether::testing {

/// A tube about the z axis of radius 1 + t/10 and length 4; a pressure of 1000 (1 + t); a velocity of 10 (1 + t) along
/// z. `off`: a run with more of each, by its tenth, by 500, by 5.
struct SimpleRun {
  double off = 0;

  static TriangleSurface tube_of(double radius) {
    return tube(16, 8, 4, [radius](double) { return radius; });
  }
  static LumenSurface imaged() { return lumen(tube_of(1)); }
  double radius(double time) const { return 1 + 0.1 * (time + off); }
  double pressure(double time) const { return 1000 * (1 + time) + 500 * off; }
  double velocity(double time) const { return 10 * (1 + time) + 5 * off; }

  FinishedMotion finished() const {
    FinishedMotion run{{0, 0.8, imaged().points, [*this](double t) { return tube_of(radius(t)).points; }},
                       [*this](const std::string&) {
                         return RunTrace{{0, 0.8}, {pressure(0), pressure(0.8)}, "g/(cm s2)"};
                       }};
    run.velocity = [*this](const Points& at, double time) { return velocities(at, time); };
    return run;
  }
  ModelMoment at(double time, const Points& asked) const {
    return {{"fluid.outlet.pressure"}, {pressure(time)}, asked, velocities(asked, time), tube_of(radius(time)).points};
  }

 private:
  Points velocities(const Points& at, double time) const {
    Points all = Points::Zero(3, at.cols());
    all.row(2).setConstant(velocity(time));
    return all;
  }
};

/// The times of all samples.
inline const std::vector<double> sample_times{0.1, 0.3, 0.5};

/// Writes what would be measured of a run, and returns what a case says of it, without its noise and closing brace.
using WriteSample = std::string (*)(const TemporaryFolder& folder, const SimpleRun& run);

inline std::string write_surfaces(const TemporaryFolder& folder, const SimpleRun& run) {
  std::string list = "file, time [s]\n";
  for (const double time : sample_times) {
    folder.file(fmt::format("s{}.stl", time), stl_text(SimpleRun::tube_of(run.radius(time))));
    list += fmt::format("s{}.stl, {}\n", time, time);
  }
  folder.file("surfaces.csv", list);
  return "{file: surfaces.csv, unit: cm";
}

inline std::string write_contours(const TemporaryFolder& folder, const SimpleRun& run) {
  std::string rows = "slice, frame, time [s], x [cm], y [cm], z [cm]\n";
  for (std::size_t frame = 0; frame < sample_times.size(); ++frame)
    for (int i = 0; i < 48; ++i) {
      const double angle = 2 * std::numbers::pi * i / 48, radius = run.radius(sample_times[frame]);
      rows += fmt::format("low, {}, {}, {:.9f}, {:.9f}, 1.9\n", frame, sample_times[frame], radius * std::cos(angle),
                          radius * std::sin(angle));
    }
  folder.file("contours.csv", rows);
  return "{file: contours.csv";
}

inline std::string write_traces(const TemporaryFolder& folder, const SimpleRun& run) {
  std::string rows = "time [s], value [dyn/cm2]\n";
  for (const double time : sample_times) rows += fmt::format("{}, {}\n", time, run.pressure(time));
  folder.file("traces.csv", rows);
  return "{observable: fluid.outlet.pressure, quantity: pressure, absolute: false, curve: {file: traces.csv}";
}

inline std::string write_velocities(const TemporaryFolder& folder, const SimpleRun& run) {
  std::string rows = "time [s], x [cm], y [cm], z [cm], v [cm/s]\n";
  for (const double time : sample_times)
    for (const double x : {-0.5, 0.0, 0.4}) rows += fmt::format("{}, {}, 0, 2, {}\n", time, x, run.velocity(time));
  folder.file("velocities.csv", rows);
  return "{file: velocities.csv, components: along, direction: [0, 0, 1]";
}

/// How a kind is sampled, with what noise, and how some of it is held out.
struct KindSample {
  WriteSample write;
  double deviation;
  std::string held_out;
};

/// Throws std::logic_error for a registered kind without a sample.
inline KindSample sample_of(const std::string& kind) {
  if (kind == "surfaces") return {write_surfaces, 0.04, "[1]"};
  if (kind == "contours") return {write_contours, 0.04, "[1]"};
  if (kind == "traces") return {write_traces, 50, "true"};
  if (kind == "velocities") return {write_velocities, 1, "[1]"};
  throw std::logic_error("no sample of " + kind + ": every kind of measurement keeps the contract");
}

}  // namespace tether::testing
