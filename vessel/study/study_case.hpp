#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "vessel/image/image_case.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/model/vessel_model.hpp"

namespace tether {

/// The file of a surface.
struct SurfaceCase {
  std::filesystem::path file;
  std::string unit;
  std::string label_array = "ModelFaceID";
  bool any_size = false;
  void declare(Fields& f);
};

/// Closed contours that the surface goes through.
struct LoftCase : ContoursCase {
  ExtendCase extend;
  bool any_size = false;
  void declare(Fields& f);
};

/// How much a surface is mended.
struct RepairCase {
  double merge = 1e-5;
  double sliver = 5e-3;
  double largest_hole = 0.3;
  int smoothing = 0;
  void declare(Fields& f);
};

/// A plane that makes an end.
struct CutPlaneCase {
  Vec3 point = Vec3::Constant(undefined), outward = Vec3::Constant(undefined);
  void declare(Fields& f);
};

/// An end of the vessel.
struct OpeningCase {
  int label = 0, order = 0;  ///< 0: not said
  std::vector<double> near;  ///< three coordinates, or empty: not said
  double trim = 0;
  std::optional<CutPlaneCase> cut;
  void declare(Fields& f);
};

/// How long edges are to be.
struct EdgeCase {
  double longest = 0.3, shortest = 0.05, per_radius = 0;
  void declare(Fields& f);
};

/// From a surface, an image or contours to a model: what the user says of it.
struct StudyCase {
  std::string name;
  std::optional<SurfaceCase> surface;  ///< one of these three
  std::optional<LumenImageCase> image;
  std::optional<LoftCase> contours;
  RepairCase repair;
  Named<OpeningCase> openings;
  std::string inlet, trunk;
  double centreline_spacing = 0.2;
  EdgeCase edges;
  std::optional<VolumeCase> model;           ///< none: the surface alone
  std::filesystem::path path;                ///< of the study itself; empty: it is no file
  std::map<std::string, std::string> lines;  ///< where each field of the file stands: "study.yaml:3"
  void declare(Fields& f);

  /// "study.yaml:3: repair.merge", with the line of its section where the file is silent of it, without one where it is
  /// silent of that too; the field alone if the study is no file.
  std::string where(const std::string& field) const;

  /// Of that one of the three that is given: the name of its section, and what is in it.
  std::string source() const { return surface ? "surface" : image ? "image" : "contours"; }
  std::filesystem::path file() const { return surface ? surface->file : image ? image->file : contours->file; }
  std::string unit() const { return surface ? surface->unit : image ? image->unit : contours->unit; }
  bool any_size() const { return surface ? surface->any_size : image ? image->any_size : contours->any_size; }
};

/// Throws InputError with a line for each mistake.
StudyCase read_study(const std::filesystem::path& file);

/// The reference of the file: "text" or "markdown".
std::string study_reference(const std::string& format);

}  // namespace tether
