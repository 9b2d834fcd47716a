#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "common/config/echo.hpp"
#include "common/io/record_file.hpp"
#include "common/io/vtu_writer.hpp"
#include "vessel/anatomy/centreline_file.hpp"
#include "vessel/model/ready_case.hpp"
#include "vessel/model/vessel_model.hpp"

namespace tether {

namespace {

namespace fs = std::filesystem;

constexpr const char* label_array = "ModelFaceID";

/// Faces in one file, each with its number; and the fields of a case that find them there.
class FaceFile {
 public:
  FaceFile(fs::path path, const Points& points) : path_(std::move(path)), points_(points) {}

  FaceCase add(const std::vector<Triangle>& triangles) {
    const int label = count_++;
    triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
    labels_.insert(labels_.end(), triangles.size(), label);
    return {path_, std::to_string(label), {}};
  }
  Named<FaceCase> add(const std::vector<Patch>& patches) {
    Named<FaceCase> faces;
    for (const Patch& patch : patches) faces.emplace_back(patch.name, add(patch.triangles));
    return faces;
  }
  void write() const { write_vtu(path_, points_, {.triangles = triangles_}, {}, {{label_array, 1, labels_}}); }

 private:
  fs::path path_;
  const Points& points_;
  std::vector<Triangle> triangles_;
  std::vector<double> labels_;
  int count_ = 0;
};

/// One value an interface node, for the nodes of all layers above it.
VectorXd on_all_layers(const VectorXd& values, Eigen::Index nodes) {
  return values.replicate(nodes / values.size(), 1);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw write_error(file);
}

/// The section `mesh`, its files named relative to the folder, so that the folder can be moved.
std::string mesh_section(MeshCase mesh, const fs::path& folder) {
  Echo echo;
  echo.group("mesh", mesh, {});
  std::string text = echo.yaml();
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
    text.erase(at, prefix.size());
  return text;
}

MeshCase write_meshes(const fs::path& folder, const VesselModel& model, const VolumeCase& study,
                      const UnitSystem& units) {
  const auto& [fluid, wall] = model.mesh;
  MeshCase mesh;
  mesh.source = "files";
  FilesCase& files = mesh.files;
  FaceFile lumen_faces(folder / "lumen_faces.vtu", fluid.points), wall_faces(folder / "wall_faces.vtu", wall.points);
  files.fluid = folder / "lumen.vtu";
  files.interface = lumen_faces.add(fluid.interface);
  files.inlets = lumen_faces.add(fluid.inlets);
  files.outlets = lumen_faces.add(fluid.outlets);
  files.wall = folder / "wall.vtu";
  files.wall_interface = wall_faces.add(wall.interface);
  files.outside = wall_faces.add(wall.outside);
  files.rings = wall_faces.add(wall.rings);
  files.centreline = folder / "centreline.csv";
  files.regions = with_objects_in(folder / "objects.csv", study.regions, units);
  lumen_faces.write();
  wall_faces.write();
  write_vtu(files.fluid, fluid.points, cells_of(fluid), {});
  write_vtu(files.wall, wall.points, cells_of(wall),
            {Field::scalars("asked_thickness", on_all_layers(model.growth.asked, wall.points.cols())),
             Field::scalars("thickness", on_all_layers(model.growth.thickness, wall.points.cols()))});
  return mesh;
}

}  // namespace

void write_model(const fs::path& folder, const std::string& name, const VesselModel& model, const CentrelineTree& tree,
                 const VolumeCase& study, const UnitSystem& units) {
  const fs::path place = fs::absolute(folder).lexically_normal();
  fs::create_directories(place);
  write_centreline(place / "centreline.csv", tree, units.symbol(dimension::length));
  write_record(place / "quality.json", model.quality);
  const MeshCase mesh = write_meshes(place, model, study, units);
  const std::string section = mesh_section(mesh, place);
  write_text(place / "case.yaml", ready_case(name, model, section, units));
  write_text(place / "flow.csv", ready_flow(model, units));
}

void remove_model(const fs::path& folder) {
  if (!fs::exists(folder / "quality.json")) return;
  for (auto name = model_files.rbegin(); name != model_files.rend();
       ++name)  // the first file says whose the others are
    fs::remove(folder / *name);
  if (fs::is_directory(folder) && fs::is_empty(folder)) fs::remove(folder);
}

}  // namespace tether
