#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/evidence/model_runs.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"

namespace tether::testing {

/// Runs of a tube about the z axis that beats with period 0.8: springs at its regions, at the halves of these along
/// the axis and at the half between their ends, each a number of the model, hold the wall back by half a millimetre a
/// unit.
struct FakeRuns : ModelRuns {
  explicit FakeRuns(const LumenSurface& of, const std::vector<std::string>& regions) : lumen(of) {
    for (const char* half : {"", "_inlet_half", "_outlet_half", "_middle_half"})
      for (const std::string& region : regions)
        infos.push_back({"solid.effects.spring_" + region + half + ".stiffness", "of the spring", "1", "linear", 0, 0,
                         0, infinite, undefined, 1});
  }
  /// Springs on patches: those that hold nothing of a region's.
  void add(const std::vector<PlacedEffect>& more) {
    for (const PlacedEffect& effect : more) {
      infos.push_back(infos.front());
      infos.back().name = effect.path + ".stiffness";
      patches[infos.back().name] = effect.extent.about.value();
    }
  }
  const std::vector<protocol::ParameterInfo>& parameters() const override { return infos; }
  std::vector<std::string> columns() const override { return {"fluid.volume"}; }
  RunsCost cost() const override { return {static_cast<int>(made.size()), static_cast<int>(made.size()), 0, 0}; }
  std::vector<FinishedMotion> make(const std::vector<WantedRun>& wanted) override {
    std::vector<FinishedMotion> all;
    for (const WantedRun& run : wanted) {
      made.push_back(run.folder);
      all.push_back(fails.contains(run.folder) ? FinishedMotion{{}, {}, {}, "too much"} : motion(run.values));
    }
    return all;
  }

  Points at(double time, const NamedValues& values) const {
    const double beat = 0.5 * (1 - std::cos(2 * std::numbers::pi * time / 0.8));
    Points x = lumen.points;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      double moved = 0.2;  // cm
      for (std::size_t k = 0; k < values.names.size(); ++k)
        moved -= 0.05 * strength * values.values[k] * share_at(values.names[k], i);
      x.col(i).head<2>() += beat * moved * lumen.points.col(i).head<2>().normalized();
    }
    return x;
  }
  /// A dent about a place that no region is drawn for acts as a bump, 8 mm wide.
  double share_at(const std::string& name, Eigen::Index node) const {
    if (const auto patch = patches.find(name); patch != patches.end())
      return (lumen.points.col(node) - patch->second.centre).norm() < patch->second.radius ? 1 : 0;
    if (name.find("disc") != std::string::npos) return (lumen.points.col(node) - dent).norm() < 1 ? 1 : 0;
    if (name.find("dent") == std::string::npos) return acts_at(name, node) ? 1 : 0;
    return std::exp(-(lumen.points.col(node) - dent).squaredNorm() / (2 * 0.8 * 0.8));
  }
  bool acts_at(const std::string& name, Eigen::Index node) const {
    const auto has = [&](const std::string& word) { return name.find(word) != std::string::npos; };
    const double middle = lumen.points.row(2).mean(), z = lumen.points(2, node);
    const double quarter = (lumen.points.row(2).maxCoeff() - lumen.points.row(2).minCoeff()) / 4;
    const auto region = static_cast<std::size_t>(lumen.region[static_cast<std::size_t>(node)]);
    return has(lumen.region_names.at(region)) && !(has("inlet_half") && z > middle) &&
           !(has("outlet_half") && z < middle) && !(has("middle_half") && std::abs(z - middle) > quarter);
  }
  FinishedMotion motion(const NamedValues& values) const {
    return {{0, 0.8, lumen.points, [this, values](double time) { return at(time, values); }},
            [this, values](const std::string&) { return volume(values); }};
  }
  /// Grows by a fifth, and by a twentieth less a unit of spring.
  RunTrace volume(const NamedValues& values) const {
    double grown = 0.2;
    for (const double value : values.values) grown -= 0.05 * strength * value;
    return {{0, 0.4, 0.8}, {100, 100 * (1 + grown), 100}, "cm3"};
  }

  static inline const Vec3 dent{-1, std::sqrt(3.0), 6};
  const LumenSurface& lumen;
  double strength = 1;  ///< of the springs: a coarser model's are not quite the model's
  std::vector<protocol::ParameterInfo> infos;
  std::map<std::string, Ball> patches;
  std::set<std::string> fails;    ///< folders of runs that do not come to their end
  std::vector<std::string> made;  ///< folders
};

}  // namespace tether::testing
