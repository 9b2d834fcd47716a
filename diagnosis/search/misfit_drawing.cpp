#include "diagnosis/search/misfit_drawing.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "common/io/vtp_writer.hpp"
#include "common/io/vtu_writer.hpp"
#include "common/mesh/triangle_locator.hpp"
#include "pictures/pictures.hpp"

namespace tether {
namespace {

/// Of a patch, on the lumen: nearest to a circle of its radius in the plane that touches it at its centre.
Points circle_on(const LumenSurface& lumen, const LocatedMisfit& patch) {
  constexpr Eigen::Index corners = 64;
  const TriangleLocator surface(lumen.points, lumen.triangles);
  const auto normal_at = [&](int triangle) -> Vec3 {
    const Triangle& t = lumen.triangles[static_cast<std::size_t>(triangle)];
    const Vec3 a = lumen.points.col(t[0]);
    return (lumen.points.col(t[1]) - a).cross(lumen.points.col(t[2]) - a).normalized();
  };
  const Vec3 normal = normal_at(surface.nearest(patch.centre).triangle);
  const Vec3 across = normal.unitOrthogonal(), along = normal.cross(across);
  Points circle(3, corners + 1);
  for (Eigen::Index k = 0; k <= corners; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / corners;
    const Vec3 way = patch.radius * (std::cos(angle) * across + std::sin(angle) * along);
    const TriangleLocator::Nearest nearest = surface.nearest(patch.centre + way);
    circle.col(k) = nearest.place + 0.02 * patch.radius * normal_at(nearest.triangle);  // above it, to be seen
  }
  return circle;
}

}  // namespace

std::vector<std::string> draw_misfit(const LumenSurface& lumen, const DiagnosisReport& report,
                                     const std::filesystem::path& output) {
  if (report.misfit_map.size() == 0) return {};
  const std::filesystem::path file = output / "misfit.vtu", circle = output / "misfit_patch.vtp";
  write_vtu(file, lumen.points, {.triangles = lumen.triangles}, {Field::scalars("significance", report.misfit_map)});
  write_vtp(circle, std::vector<Points>{circle_on(lumen, *report.located.after)});
  const bool is_drawn =
      has_display_server() && draw_picture(file, output / "plots/misfit.png",
                                           {"--field", "significance", "--title", "what is left:\nsignificance (z)",
                                            "--lines", circle.string()});
  return is_drawn ? std::vector<std::string>{"misfit.png"} : std::vector<std::string>{};
}

}  // namespace tether
