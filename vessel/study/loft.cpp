#include "vessel/study/loft.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "common/base/placed_error.hpp"
#include "vessel/contours.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace {

/// Triangles are made anew of it: they are to be finer than those. A round vessel loses a twentieth of a per cent of
/// its radius between them.
constexpr int points_around = 96;
constexpr int most_along = 10000;

Points middles_of(const std::vector<Points>& contours) {
  Points middles(3, std::ssize(contours));
  for (Eigen::Index k = 0; k < middles.cols(); ++k)
    middles.col(k) = contours[static_cast<std::size_t>(k)].rowwise().mean();
  return middles;
}

/// Across the vessel everywhere, as far as there is such a direction: across the plane that it lies nearest to.
Vec3 direction_across(const Points& middles) {
  const Points centred = middles.colwise() - middles.rowwise().mean();
  return Eigen::JacobiSVD<MatrixXd>(centred, Eigen::ComputeFullU).matrixU().col(2);
}

double perimeter(const Points& contour) {
  double length = (contour.rightCols<1>() - contour.leftCols<1>()).norm();
  for (Eigen::Index i = 1; i < contour.cols(); ++i) length += (contour.col(i) - contour.col(i - 1)).norm();
  return length;
}

/// Intervals along the vessel as long as those around it.
int intervals_along(const SweepSettings& settings, const Points& middles) {
  double length = settings.extend_inlet + settings.extend_outlet, around = 0;
  for (Eigen::Index k = 1; k < middles.cols(); ++k) length += (middles.col(k) - middles.col(k - 1)).norm();
  for (const Points& contour : settings.sections) around += perimeter(contour) / double(settings.sections.size());
  return static_cast<int>(std::clamp(std::ceil(length / around * points_around), 1.0, double(most_along)));
}

/// A wall through the rims, and a fan at either end.
RawSurface through(const std::vector<CrossSection>& sections) {
  RawSurface surface;
  const int count = static_cast<int>(sections.size());
  surface.points.resize(3, count * points_around + 2);
  const auto node = [](int section, int around) { return section * points_around + around % points_around; };
  const auto add = [&](const Triangle& triangle, int face) {
    surface.triangles.push_back(triangle);
    surface.face_id.push_back(face);
  };
  for (int k = 0; k < count; ++k)
    surface.points.middleCols(node(k, 0), points_around) = sections[static_cast<std::size_t>(k)].rim;
  const int inlet = count * points_around, outlet = inlet + 1;
  surface.points.col(inlet) = sections.front().rim.rowwise().mean();
  surface.points.col(outlet) = sections.back().rim.rowwise().mean();
  for (int i = 0; i < points_around; ++i) {
    for (int k = 0; k + 1 < count; ++k) {
      add({node(k, i), node(k, i + 1), node(k + 1, i + 1)}, 0);
      add({node(k, i), node(k + 1, i + 1), node(k + 1, i)}, 0);
    }
    add({inlet, node(0, i + 1), node(0, i)}, 1);
    add({outlet, node(count - 1, i), node(count - 1, i + 1)}, 2);
  }
  return surface;
}

/// A vessel turns between one contour and the next by less than a right angle.
void require_order(const Points& middles, const std::string& field) {
  for (Eigen::Index i = 2; i < middles.cols(); ++i)
    if ((middles.col(i) - middles.col(i - 1)).dot(middles.col(i - 1) - middles.col(i - 2)) < 0)
      throw PlacedError(
          fmt::format("{}: contour {} lies back toward contour {}: they must stand in order along the vessel", field,
                      i + 1, i - 1),
          {middles.col(i)});
}

}  // namespace

RawSurface surface_through(const LoftCase& given, const std::string& field) {
  SweepSettings settings;
  settings.field = field;
  settings.sections = read_contours(given.file);
  for (Points& contour : settings.sections) contour *= in_cm(given.unit);
  settings.extend_inlet = given.extend.inlet;
  settings.extend_outlet = given.extend.outlet;
  settings.disc.around = points_around;
  if (settings.sections.size() > 1) {
    const Points middles = middles_of(settings.sections);
    require_order(middles, field);
    settings.angle_origin = direction_across(middles);
    settings.along = intervals_along(settings, middles);
  }
  return through(cross_sections(settings));
}

}  // namespace tether
