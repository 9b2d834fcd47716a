#include "observation_manager/measurements/flow_observations.hpp"

namespace tether {

std::vector<const Measurement*> FlowObservations::all() const {
  std::vector<const Measurement*> sources;
  for (const Trace& trace : traces) sources.push_back(&trace);
  for (const VelocitySeries& series : velocities) sources.push_back(&series);
  for (const auto& other : others) sources.push_back(other.get());
  return sources;
}

Points FlowObservations::points() const {
  Points all_points(3, 0);
  for (const Measurement* source : all()) {
    const Points points = source->velocity_points();
    all_points.conservativeResize(3, all_points.cols() + points.cols());
    all_points.rightCols(points.cols()) = points;
  }
  return all_points;
}

FlowObservations load_flow_observations(const ObservationsCase& given, const CaseFile& file) {
  FlowObservations result;
  for (const auto& section : given.sections())
    if (section->kind().load != nullptr) section->kind().load(*section, file, result);
  return result;
}

}  // namespace tether
