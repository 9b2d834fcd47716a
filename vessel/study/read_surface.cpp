#include "vessel/study/read_surface.hpp"

#include "vessel/mesh_file.hpp"
#include "vessel/surface/vessel_size.hpp"

namespace tether {
namespace {

bool is_a_vessels(double radius) {
  return radius >= least_vessel_radius && radius <= most_vessel_radius;
}

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

std::string wrong_width(double radius, const std::string& given) {
  if (is_a_vessels(radius)) return "";
  std::string fitting;
  for (const char* unit : {"mm", "cm", "m"})
    if (const double other = radius / in_cm(given) * in_cm(unit); is_a_vessels(other))
      fitting += fmt::format("{}{} ({:.3g} cm)", fitting.empty() ? "" : " or ", unit, 2 * other);
  return fmt::format("its largest opening is {:.3g} cm wide in {}, which no vessel is{}", 2 * radius, given,
                     fitting.empty() ? "" : "; did you mean " + fitting);
}

void check_unit(const StudyCase& study, double radius) {
  const std::string wrong = study.any_size() ? "" : wrong_width(radius, study.unit());
  if (!wrong.empty())
    throw input_error("{}: {}; {}.any_size: true takes it as it is", study.file().string(), wrong, study.source());
}

}  // namespace tether
