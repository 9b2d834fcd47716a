#pragma once

#include "common/config/case_file.hpp"
#include "tests/identification_master/breathing_tube.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether::testing {

constexpr int frames = 10;
constexpr double deviation = 0.06, correlation = 0.5;
inline const LastingAllowance nothing_lasts{0, 0, 0};

/// Two parameters, linear, with a wide prior.
inline IdentifiedParameters parameters_of_tube() {
  static const TemporaryFolder folder;
  const auto path = folder / "case.yaml";
  std::ofstream(path) << "name: tube\nunits: cgs\ntime: {step: 0.01, end: 0.8}\n";
  const CaseFile file(path);
  IdentificationCase given;
  for (const char* name : {"front", "rear"}) {
    ParameterCase parameter;
    parameter.of = {name};
    parameter.mean = 0.1;
    parameter.deviation = 0.2;
    given.parameters.emplace_back(name, parameter);
  }
  std::vector<protocol::ParameterInfo> announced;
  for (const char* name : {"front", "rear"})
    announced.push_back({name, "", "cm", "linear", 0.1, 0, -infinite, infinite, 1, 1});
  return {given, announced, file};
}

/// Ten surfaces of a true tube of its own mesh over a beat.
inline Observations surfaces(int around, int along, double front, double rear, int model_around, int model_along,
                             CorrelatedErrors* errors = nullptr) {
  std::vector<SurfaceFrame> list;
  for (int k = 0; k < frames; ++k) {
    const double time = BreathingTube::beat * k / frames;
    TriangleSurface surface = BreathingTube::measured(around, along, time, front, rear);
    if (errors != nullptr) {
      const VectorXd e = errors->draw();
      for (Eigen::Index i = 0; i < e.size(); ++i)
        surface.points.col(i).head<2>() *= 1 + e(i) / surface.points.col(i).head<2>().norm();
    }
    list.push_back({time, std::move(surface), {}});
  }
  const LumenSurface model = lumen(BreathingTube::at(model_around, model_along, 0, 0, 0));
  SourceSettings settings = settings_for(model);
  settings.period = BreathingTube::beat;
  settings.noise = {deviation, correlation, 0};
  Observations data;
  data.lumen.push_back(
      std::make_unique<SurfaceSeries>(settings, std::move(list), std::vector<bool>(frames, false), model));
  return data;
}

/// allowed: what the data may be off by at all times.
inline EstimateRecord identified(const Observations& data, int around, int along, double dt, bool every_step = true,
                                 const LastingAllowance& allowed = nothing_lasts) {
  BreathingEnsemble ensemble(data, around, along);
  const IdentifiedParameters parameters = parameters_of_tube();
  DataPrecision precision(data, ensemble.lumen(), dt, {0, BreathingTube::beat});
  if (!every_step) precision.count_frames_whole();
  IdentificationPlan plan{.start = 0,
                          .dt = dt,
                          .steps = std::lround(BreathingTube::beat / dt),
                          .every_step = every_step,
                          .largest_shift = 1e9};
  const LumenSurface model = lumen(BreathingTube::at(around, along, 0, 0, 0));
  Identification filter(plan, parameters, precision, data, ensemble,
                        {data, model, ensemble.lumen(), allowed, plan.ends()});
  while (!filter.is_done()) filter.advance();
  return filter.last();
}

inline VectorXd deviations(const EstimateRecord& estimate) {
  return estimate.covariance.diagonal().cwiseSqrt();
}

}  // namespace tether::testing
