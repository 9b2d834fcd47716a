#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "vessel/coordinates.hpp"
#include "vessel/polar_curve.hpp"
#include "vessel/sweep.hpp"

namespace tether {

namespace {

/// Lines of equal angle along the lumen, one column each; the last column is the axis. Cubic Hermite between the given
/// stations with slopes of the parabola through three of them; straight along an extension.
class Lines {
 public:
  /// stations: one matrix each, all of the same width, at least two.
  Lines(std::vector<Points> stations, bool straight_inlet, bool straight_outlet) : stations_(std::move(stations)) {
    parameters_.push_back(0);
    for (std::size_t k = 1; k < stations_.size(); ++k)
      parameters_.push_back(parameters_.back() + (stations_[k] - stations_[k - 1]).rightCols<1>().norm());
    for (std::size_t k = 0; k < stations_.size(); ++k) slopes_.push_back(parabola_slope(k));
    const std::size_t end = stations_.size() - 1;
    if (straight_inlet) slopes_[0] = slopes_[1] = chord(0).colwise().normalized();
    if (straight_outlet) slopes_[end] = slopes_[end - 1] = chord(end - 1).colwise().normalized();
  }

  Eigen::Index axis() const { return stations_.front().cols() - 1; }
  double end() const { return parameters_.back(); }
  const Points& first() const { return stations_.front(); }
  const Points& last() const { return stations_.back(); }

  Vec3 point(Eigen::Index line, double u) const {
    const auto [k, t, h] = place(u);
    const double s = 1 - t;
    return s * s * (1 + 2 * t) * stations_[k].col(line) + t * t * (1 + 2 * s) * stations_[k + 1].col(line) +
           h * s * t * (s * slopes_[k].col(line) - t * slopes_[k + 1].col(line));
  }

  Vec3 tangent(Eigen::Index line, double u) const {
    const auto [k, t, h] = place(u);
    const double s = 1 - t;
    const Vec3 derivative = 6 * s * t / h * (stations_[k + 1].col(line) - stations_[k].col(line)) +
                            s * (s - 2 * t) * slopes_[k].col(line) + t * (t - 2 * s) * slopes_[k + 1].col(line);
    return derivative.normalized();
  }

 private:
  struct Place {
    std::size_t interval;
    double t, length;
  };
  Place place(double u) const {
    const auto above = std::upper_bound(parameters_.begin() + 1, parameters_.end() - 1, u);
    const auto k = static_cast<std::size_t>(above - parameters_.begin()) - 1;
    const double h = parameters_[k + 1] - parameters_[k];
    return {k, std::clamp((u - parameters_[k]) / h, 0.0, 1.0), h};
  }

  Points chord(std::size_t k) const {
    return (stations_[k + 1] - stations_[k]) / (parameters_[k + 1] - parameters_[k]);
  }

  /// Derivative at station k of the parabola through it and its neighbours (at an end: through the last three).
  Points parabola_slope(std::size_t k) const {
    if (stations_.size() == 2) return chord(0);
    const std::size_t m = std::clamp<std::size_t>(k, 1, stations_.size() - 2);
    const double h0 = parameters_[m] - parameters_[m - 1], h1 = parameters_[m + 1] - parameters_[m];
    const double weight = k < m ? -h0 : k > m ? h0 + 2 * h1 : h0;
    return chord(m - 1) + (chord(m) - chord(m - 1)) * (weight / (h0 + h1));
  }

  std::vector<Points> stations_, slopes_;
  std::vector<double> parameters_;
};

Points with_axis(const Points& points, const Vec3& centre) {
  Points both(3, points.cols() + 1);
  both << points, centre;
  return both;
}

/// The section moved straight along `direction` (away from the vessel) into the plane across it, `distance` from the
/// section's centre.
Points extended(const Points& section, const Vec3& direction, double distance, const std::string& field) {
  const Vec3 centre = section.rightCols<1>();
  const Eigen::RowVectorXd remaining = distance - (direction.transpose() * (section.colwise() - centre)).array();
  if (const double reach = distance - remaining.minCoeff(); remaining.minCoeff() < 0.05 * distance)
    throw input_error(
        "{}: {:.4g} is too short: the section's plane is oblique and its edge reaches {:.4g} along the axis", field,
        distance, reach);
  return section + direction * remaining;
}

/// All sections at the same angles, with their centres, and the extensions.
Lines lines_through(const SweepSettings& settings) {
  const std::size_t count = settings.sections.size();
  if (count < 2) throw input_error("{}: {} cross-sections: at least two are needed", settings.field, count);
  std::vector<Points> stations;
  for (std::size_t k = 0; k < count; ++k) {
    const Points& before = settings.sections[k == 0 ? 0 : k - 1];
    const Points& after = settings.sections[std::min(k + 1, count - 1)];
    const Vec3 along = after.rowwise().mean() - before.rowwise().mean();
    const PolarCurve curve(settings.sections[k], along, settings.angle_origin,
                           fmt::format("{}: cross-section {}", settings.field, k));
    stations.push_back(with_axis(curve.sample(4 * settings.disc.around), curve.frame().centre));
  }
  const Vec3 to_inlet = (stations[0] - stations[1]).rightCols<1>().normalized();
  const Vec3 to_outlet = (stations[count - 1] - stations[count - 2]).rightCols<1>().normalized();
  if (settings.extend_inlet > 0)
    stations.insert(stations.begin(),
                    extended(stations.front(), to_inlet, settings.extend_inlet, settings.field + ".extend.inlet"));
  if (settings.extend_outlet > 0)
    stations.push_back(extended(stations.back(), to_outlet, settings.extend_outlet, settings.field + ".extend.outlet"));
  return {std::move(stations), settings.extend_inlet > 0, settings.extend_outlet > 0};
}

/// Parameters of the axis at `count + 1` equal distances along it.
std::vector<double> equal_distances(const Lines& lines, int count) {
  constexpr int samples = 4000;
  std::vector<double> length{0};
  Vec3 last = lines.point(lines.axis(), 0);
  for (int i = 1; i <= samples; ++i) {
    const Vec3 next = lines.point(lines.axis(), lines.end() * i / samples);
    length.push_back(length.back() + (next - last).norm());
    last = next;
  }
  std::vector<double> parameters;
  for (int i = 0; i <= count; ++i) {
    const double target = length.back() * i / count;
    const auto above =
        static_cast<std::size_t>(std::upper_bound(length.begin() + 1, length.end() - 1, target) - length.begin());
    const double t = (target - length[above - 1]) / (length[above] - length[above - 1]);
    parameters.push_back(lines.end() * (static_cast<double>(above - 1) + t) / samples);
  }
  return parameters;
}

/// Where a line meets the plane, by bisection: it runs from behind the plane to before it.
Vec3 crossing(const Lines& lines, Eigen::Index line, const Vec3& origin, const Vec3& normal) {
  double behind = 0, before = lines.end();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (behind + before);
    ((lines.point(line, middle) - origin).dot(normal) < 0 ? behind : before) = middle;
  }
  return lines.point(line, 0.5 * (behind + before));
}

Vec3 normal_of(const Points& station, const Vec3& angle_origin, const Vec3& along) {
  return PolarCurve(station.leftCols(station.cols() - 1), along, angle_origin, "mesh: end section").frame().normal;
}

/// The normal of a cut: across the axis, turning into the end planes over the last diameter.
class CutNormals {
 public:
  CutNormals(const Lines& lines, const Vec3& angle_origin)
      : lines_(lines),
        inlet_(normal_of(lines.first(), angle_origin, lines.tangent(lines.axis(), 0))),
        outlet_(normal_of(lines.last(), angle_origin, lines.tangent(lines.axis(), lines.end()))),
        diameter_(2 * (lines.first().colwise() - Vec3(lines.first().rightCols<1>())).colwise().norm().maxCoeff()) {}
  Vec3 at(double u) const {
    const double i = weight(u), o = weight(lines_.end() - u);
    return (i * inlet_ + o * outlet_ + std::max(1 - i - o, 0.0) * lines_.tangent(lines_.axis(), u)).normalized();
  }

 private:
  /// 1 at an end, 0 from a diameter (at most half the vessel) on.
  double weight(double distance) const {
    const double t = std::clamp(distance / std::min(diameter_, 0.5 * lines_.end()), 0.0, 1.0);
    return (1 - t) * (1 - t) * (1 + 2 * t);
  }
  const Lines& lines_;
  Vec3 inlet_, outlet_;
  double diameter_;
};

Points cut(const Lines& lines, double u, const Vec3& normal) {
  if (u <= 0) return lines.first().leftCols(lines.axis());
  if (u >= lines.end()) return lines.last().leftCols(lines.axis());
  const Vec3 origin = lines.point(lines.axis(), u);
  Points points(3, lines.axis());
  for (Eigen::Index line = 0; line < lines.axis(); ++line) points.col(line) = crossing(lines, line, origin, normal);
  return points;
}

}  // namespace

std::vector<CrossSection> cross_sections(const SweepSettings& settings) {
  if (settings.along < 1) throw input_error("{}.along: {}: must be at least 1", settings.field, settings.along);
  const Lines lines = lines_through(settings);
  const CutNormals normals(lines, settings.angle_origin);
  std::vector<CrossSection> sections;
  for (const double u : equal_distances(lines, settings.along)) {
    const Vec3 normal = normals.at(u);
    const PolarCurve curve(
        cut(lines, u, normal), normal, settings.angle_origin,
        fmt::format("{}: the section at {}", settings.field, coordinates(lines.point(lines.axis(), u))));
    sections.push_back({curve.frame().centre, curve.frame().normal, curve.sample(settings.disc.around)});
  }
  return sections;
}

}  // namespace tether
