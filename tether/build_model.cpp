#include <fstream>
#include <functional>
#include <iostream>

#include "common/base/write_error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "common/io/vtp_writer.hpp"
#include "pictures/pictures.hpp"
#include "tether/new_results.hpp"
#include "tether/verbs.hpp"
#include "vessel/image/slices.hpp"
#include "vessel/study/build_surface.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* build_model_verb = "build-model";

/// A cross of three lines at each place, a hundredth of an aorta's length wide.
std::vector<Points> crosses(const std::vector<Vec3>& places) {
  constexpr double arm = 0.2;  // [cm]
  std::vector<Points> lines;
  for (const Vec3& place : places)
    for (int axis = 0; axis < 3; ++axis) {
      Points& line = lines.emplace_back(3, 2);
      line.col(0) = place - arm * Vec3::Unit(axis);
      line.col(1) = place + arm * Vec3::Unit(axis);
    }
  return lines;
}

/// A table, and lines to look at.
void write_tree(const fs::path& table_file, const fs::path& lines_file, const CentrelineTree& tree) {
  std::vector<Points> lines;
  std::vector<double> radii;
  std::ofstream table(table_file);
  table << "branch, parent, x [cm], y [cm], z [cm], radius [cm]\n";
  for (const Branch& branch : tree.branches) {
    Points& line = lines.emplace_back(3, static_cast<Eigen::Index>(branch.points.size()));
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const Vec3& x = branch.points[i];
      line.col(static_cast<Eigen::Index>(i)) = x;
      table << fmt::format("{}, {}, {:.9g}, {:.9g}, {:.9g}, {:.9g}\n", branch.name,
                           branch.parent < 0 ? "" : tree.branches[branch.parent].name, x[0], x[1], x[2],
                           branch.radii[i]);
    }
    radii.insert(radii.end(), branch.radii.begin(), branch.radii.end());
  }
  if (!table.flush()) throw write_error(table_file);
  write_vtp(lines_file, lines, "radius", radii);
}

const std::vector<fs::path> surface_files{"surface.vtp", "centreline.vtp", "centreline.csv", "surface.json"};

/// What a study's surface and model are, in the order in which new ones take the places of old ones. A person may go on
/// with any of them: a surface is smoothed, a mesh repaired.
std::vector<fs::path> names_of_results(bool has_model) {
  std::vector<fs::path> names = surface_files;
  if (!has_model) return names;
  for (const char* name : model_files) names.push_back(fs::path("model") / name);
  return names;
}

/// Held; what is in it is as it was.
fs::path hold_folder_of(const CommandLine& command, const StudyCase& study) {
  const std::vector<fs::path> all = names_of_results(true);
  const auto model = all.begin() + static_cast<long>(surface_files.size());
  const fs::path folder =
      hold_for_made(command, {build_model_verb, study.name, {}, {model, all.end()}, "model/quality.json"});
  check_keeps_work(folder, {build_model_verb, study.name, {}, surface_files, "surface.json"}, command.overwrite);
  if (command.overwrite) note_as_they_are(folder, surface_files);
  return folder;
}

void write_surface(const NewResults& results, const BuiltSurface& built) {
  write_vtp(results.beside("surface.vtp"), built.surface.points, built.surface.triangles, built.surface.label);
  write_tree(results.beside("centreline.csv"), results.beside("centreline.vtp"), built.tree);
  write_record(results.beside("surface.json"), built.summary);
}

/// What `write` writes is beside what is there, which stays if the disk does not take it.
void write_beside(const fs::path& folder, const std::function<void()>& write) {
  const bool has_old = fs::exists(folder / "surface.json");
  try {
    write();
  } catch (const RunError& error) {
    throw run_error("{}{}", error.what(),
                    has_old ? "; the surface and the model that were there are as they were" : "");
  }
}

void draw(const fs::path& folder, const std::string& name) {
  std::vector<std::string> options{"--field", "ModelFaceID", "--title", "0: wall, others: openings"};
  if (fs::exists(folder / "centreline.vtp"))
    options.insert(options.end(), {"--lines", (folder / "centreline.vtp").string()});
  if (has_display_server()) draw_picture(folder / (name + ".vtp"), folder / (name + ".png"), options);
}

std::string model_text(const ModelQuality& quality) {
  std::string text = fmt::format(
      "Blood: {} nodes, {} tetrahedra, least dihedral angle {:.1f} degrees\n"
      "Wall: {} nodes, {} prisms, {:.3g} to {:.3g} cm thick, at least {:.0f} % of what was asked\n",
      quality.blood.nodes, quality.blood.elements, quality.blood.least_dihedral, quality.wall.nodes,
      quality.wall.elements, quality.thickness.least, quality.thickness.most, 100 * quality.thickness.least_share);
  for (const RegionArea& region : quality.regions) text += fmt::format("  {}: {:.4g} cm2\n", region.name, region.area);
  for (const std::string& warning : quality.warnings) text += "Look at it: " + warning + "\n";
  return text;
}

/// What the study asks of a model that cannot be is told with the study's file, and its places are marked.
VesselModel model_of(const BuiltSurface& built, const VolumeCase& asked, const UnitSystem& units, const fs::path& study,
                     const fs::path& places) {
  try {
    return build_model(built.surface, built.tree, asked, units);
  } catch (const PlacedError& error) {
    write_vtp(places, crosses(error.places));
    throw input_error("{}: {} (marked in {})", study.string(), error.what(), places.string());
  } catch (const InputError& error) {
    throw input_error("{}: {}", study.string(), error.what());
  }
}

}  // namespace

Made<SurfaceSummary> build_model(const CommandLine& command) {
  const StudyCase study = read_study(command.case_file);
  const fs::path folder = hold_folder_of(command, study);
  const fs::path places = folder / "places.vtp";
  fs::remove(places);
  const auto say = [&](const std::string& what) {
    if (!command.quiet) std::cout << what << std::endl;
  };
  const auto keep = [&](const std::string& step, const RawSurface& surface) {
    say(fmt::format("{}: {} triangles", step, surface.triangles.size()));
    write_beside(folder,
                 [&] { write_vtp(folder / (step + ".vtp"), surface.points, surface.triangles, surface.face_id); });
  };
  try {
    BuiltSurface built = build_surface(study, keep, [&](const ImageVolume& image, const RawSurface& lumen) {
      draw_slices(folder / "1_slices.png", image, lumen);
    });
    const UnitSystem units = UnitSystem::cgs();
    std::optional<VesselModel> model;
    keep("5_ready", {built.surface.points, built.surface.triangles, built.surface.label});
    if (study.model) {
      say("The surface is ready: tetrahedra, wall and regions");
      model = model_of(built, *study.model, units, command.case_file, places);
    }
    const NewResults results(folder, names_of_results(model.has_value()));
    write_beside(folder, [&] {
      write_surface(results, built);
      if (model) {
        make_folder(results.beside("model"));
        write_model(results.beside("model"), study.name + "_model", *model, built.tree, *study.model, units);
      }
      mark_made(folder, build_model_verb, command.case_file);
      results.note(names_of_results(true));
    });
    // nothing speaks against new results any more
    if (model)
      fs::remove(folder / "model/case.yaml");  // it comes last: where it is, the model is whole
    else
      remove_model(folder / "model");  // it was of another surface
    results.put_in_place();
    for (const char* picture : {"1_read", "2_repaired", "3_opened", "4_closed", "surface"}) draw(folder, picture);
    std::string told =
        text_of(built.summary) + "In " + folder.string() + ": surface.vtp, centreline.vtp, surface.json, pictures\n";
    if (model)
      told += model_text(model->quality) +
              fmt::format("In {0}: meshes, quality.json, case.yaml: tether simulate {0}/case.yaml\n",
                          (folder / "model").string());
    return {std::move(built.summary), std::move(told)};
  } catch (const PlacedError& error) {
    write_vtp(places, crosses(error.places));
    throw input_error("{}: {} (marked in {})", study.file().string(), error.what(), places.string());
  }
}

void check_study(const CommandLine& command) {
  read_study(command.case_file);
}

}  // namespace tether
