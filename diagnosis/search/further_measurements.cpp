#include "diagnosis/search/further_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "common/mesh/surface.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double of_range = 0.03;    ///< deviation of a measured flow or pressure over the range of the run's
constexpr int values_of_trace = 40;  ///< independent ones

/// Simulates measurements from runs.
class Simulated {
 public:
  Simulated(const DiagnosedCase& given, const std::vector<FinishedMotion>& runs) : given_(given), runs_(runs) {}

  FurtherMeasurement trace(const std::string& column) const {
    const RunTrace base = runs_.front().trace(column);
    const auto [least, most] = std::minmax_element(base.values.begin(), base.values.end());
    const double deviation = of_range * (*most - *least);
    FurtherMeasurement all{text_of(column),
                           fmt::format("errors of {:.0f} % of its range, {} values", 100 * of_range, values_of_trace),
                           MatrixXd(values_of_trace, static_cast<Index>(runs_.size())),
                           VectorXd::Constant(values_of_trace, deviation > 0 ? 1 / (deviation * deviation) : 0)};
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const RunTrace run = runs_[k].trace(column);
      for (Index i = 0; i < values_of_trace; ++i)
        all.values(i, static_cast<Index>(k)) =
            run.values[static_cast<std::size_t>(i + 1) * (run.values.size() - 1) / values_of_trace];
    }
    return all;
  }

  /// The lumen's nodes at some moments: their distance along the base's normals, or all three components.
  FurtherMeasurement lumen(const std::string& name, const std::string& assuming, const std::vector<double>& times,
                           const Noise& noise, bool components) const {
    const Index nodes = given_.lumen.points.cols(), each = components ? 3 * nodes : nodes;
    FurtherMeasurement all{name, assuming,
                           MatrixXd(each * static_cast<Index>(times.size()), static_cast<Index>(runs_.size())),
                           VectorXd(each * static_cast<Index>(times.size()))};
    const VectorXd independent = nodal_areas(given_.lumen.points, given_.lumen.triangles) /
                                 (2 * std::numbers::pi * std::pow(noise.correlation_length, 2));
    for (std::size_t t = 0; t < times.size(); ++t) {
      const Points normals = nodal_normals(runs_.front().motion.positions(times[t]), given_.lumen.triangles);
      const Index first = each * static_cast<Index>(t);
      for (std::size_t k = 0; k < runs_.size(); ++k) {
        const Points x = runs_[k].motion.positions(times[t]);
        auto column = all.values.col(static_cast<Index>(k)).segment(first, each);
        column = components ? VectorXd(x.reshaped()) : VectorXd(x.cwiseProduct(normals).colwise().sum().transpose());
      }
      for (Index i = 0; i < each; ++i)
        all.precision(first + i) = independent(components ? i / 3 : i) / std::pow(noise.deviation, 2);
    }
    return all;
  }

 private:
  /// "pressure at outlet" of fluid.outlet.pressure.
  static std::string text_of(const std::string& column) {
    const std::size_t first = column.find('.'), last = column.rfind('.');
    return column.substr(last + 1) + " at " + column.substr(first + 1, last - first - 1);
  }

  const DiagnosedCase& given_;
  const std::vector<FinishedMotion>& runs_;
};

bool is_at_opening(const std::string& column) {
  return column.starts_with("fluid.") && std::count(column.begin(), column.end(), '.') == 2 &&
         (column.ends_with(".pressure") || column.ends_with(".flow"));
}

std::vector<double> halfway(const std::set<double>& times) {
  std::vector<double> all;
  for (auto next = times.begin(); next != times.end(); ++next)
    if (std::next(next) != times.end()) all.push_back(0.5 * (*next + *std::next(next)));
  return all;
}

}  // namespace

std::vector<FurtherMeasurement> further_measurements(const DiagnosedCase& given, const Evidence& evidence,
                                                     const std::vector<FinishedMotion>& base_and_others,
                                                     const std::vector<std::string>& columns) {
  const Simulated simulated(given, base_and_others);
  std::vector<FurtherMeasurement> all;
  const auto is_measured = [&](const std::string& column) {
    return std::any_of(given.data.traces.begin(), given.data.traces.end(),
                       [&](const Trace& trace) { return trace.observable == column; });
  };
  for (const std::string& column : columns)
    if (is_at_opening(column) && !is_measured(column)) all.push_back(simulated.trace(column));
  if (given.data.lumen.empty()) return all;
  std::set<double> times;
  for (const auto& part : evidence.parts())
    if (evidence.fallible(part).in_place) times.insert(part.time);
  const Noise& noise = given.data.lumen.front()->settings().noise;
  const std::vector<double> same(times.begin(), times.end());
  all.push_back(simulated.lumen("twice the frames", "frames halfway between those at hand, with the same noise",
                                halfway(times), noise, false));
  if (given.data.lumen.front()->sample_dimension() != 2)
    all.push_back(simulated.lumen("the whole lumen", "surfaces at the times of the contours, with their noise", same,
                                  noise, false));
  all.push_back(simulated.lumen("displacements of the wall itself",
                                "as by tagged MR, at the times and with the noise of the frames", same, noise, true));
  FurtherMeasurement quieter{"the same frames with half the noise", "half its deviation",
                             MatrixXd(0, static_cast<Index>(base_and_others.size())), VectorXd(0)};
  quieter.precision_factor = 4;
  all.push_back(quieter);
  return all;
}

}  // namespace tether
