#include "vessel/centreline/curve.hpp"

#include <algorithm>
#include <cmath>

namespace tether {

std::vector<double> arc_lengths(const Polyline& line) {
  std::vector<double> arc(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) arc[i] = arc[i - 1] + (line[i] - line[i - 1]).norm();
  return arc;
}

namespace {

std::size_t segment_at(const std::vector<double>& arc, double s) {
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
  return static_cast<std::size_t>(above - arc.begin()) - 1;
}

}  // namespace

Vec3 point_at(const Polyline& line, double s) {
  const std::vector<double> arc = arc_lengths(line);
  const std::size_t i = segment_at(arc, s);
  const double length = arc[i + 1] - arc[i];
  const double t = length > 0 ? std::clamp((s - arc[i]) / length, 0.0, 1.0) : 0;
  return line[i] + t * (line[i + 1] - line[i]);
}

Vec3 direction_at(const Polyline& line, double s) {
  const std::size_t i = segment_at(arc_lengths(line), s);
  return (line[i + 1] - line[i]).normalized();
}

Polyline resampled(const Polyline& line, double spacing) {
  const double whole = arc_lengths(line).back();
  const int pieces = std::max(1, static_cast<int>(std::lround(whole / spacing)));
  Polyline result;
  for (int i = 0; i <= pieces; ++i) result.push_back(point_at(line, whole * i / pieces));
  return result;
}

Polyline smoothed(const Polyline& line, double width) {
  const std::vector<double> arc = arc_lengths(line);
  Polyline result = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    // a narrower, symmetric window near an end: a one-sided mean would pull the line inward
    const double reach = std::min({3 * width, arc[i], arc.back() - arc[i]}), sigma = reach / 3;
    Vec3 sum = line[i];
    double weights = 1;
    for (std::size_t j = 0; j < line.size(); ++j) {
      const double d = arc[j] - arc[i];
      if (j == i || std::abs(d) > reach) continue;
      const double weight = std::exp(-d * d / (2 * sigma * sigma));
      sum += weight * line[j], weights += weight;
    }
    result[i] = sum / weights;
  }
  return result;
}

PlaceOnLine nearest_on(const Polyline& line, const Vec3& x) {
  PlaceOnLine best{line.front(), 0, (x - line.front()).norm()};
  double arc = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 along = line[i] - line[i - 1];
    const double length = along.norm();
    const double t = length > 0 ? std::clamp((x - line[i - 1]).dot(along) / (length * length), 0.0, 1.0) : 0;
    const Vec3 at = line[i - 1] + t * along;
    if ((x - at).norm() < best.distance) best = {at, arc + t * length, (x - at).norm()};
    arc += length;
  }
  return best;
}

}  // namespace tether
