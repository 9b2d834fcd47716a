#include "vessel/study/read_surface.hpp"

#include "vessel/mesh_file.hpp"

namespace tether {
namespace {

// A newborn's aorta is 6 mm wide, a giant aneurysm 12 cm.
constexpr double least_radius = 0.25, most_radius = 6;  // [cm]

}  // namespace

RawSurface read_surface(const SurfaceCase& given) {
  const MeshFile file = read_mesh_file(given.file);
  if (file.triangles.empty()) throw input_error("{}: holds no triangle", file.name);
  if (!file.points.allFinite()) throw input_error("{}: has a coordinate that is not finite", file.name);
  const Vec3 size = file.points.rowwise().maxCoeff() - file.points.rowwise().minCoeff();
  if (size.minCoeff() < 1e-6 * size.maxCoeff())
    throw input_error("{}: is flat: {:.3g} x {:.3g} x {:.3g} {}", file.name, size[0], size[1], size[2], given.unit);
  RawSurface surface{in_cm(given.unit) * file.points, file.triangles, std::vector<int>(file.triangles.size(), 0)};
  if (const auto labels = file.triangle_labels.find(given.label_array); labels != file.triangle_labels.end())
    surface.face_id.assign(labels->second.begin(), labels->second.end());
  return surface;
}

void check_unit(const StudyCase& study, double radius) {
  const bool any_size = study.surface ? study.surface->any_size : study.image->any_size;
  const std::string& given = study.surface ? study.surface->unit : study.image->unit;
  if (any_size || (radius >= least_radius && radius <= most_radius)) return;
  std::string fitting;
  for (const char* unit : {"mm", "cm", "m"})
    if (const double other = radius / in_cm(given) * in_cm(unit); other >= least_radius && other <= most_radius)
      fitting += fmt::format("{}{} ({:.3g} cm)", fitting.empty() ? "" : " or ", unit, 2 * other);
  throw input_error(
      "{}: its largest opening is {:.3g} cm wide in {}, which no vessel is{}; {}.any_size: true takes it as it is",
      study.file().string(), 2 * radius, given, fitting.empty() ? "" : "; did you mean " + fitting,
      study.surface ? "surface" : "image");
}

}  // namespace tether
