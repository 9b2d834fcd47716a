#include "vessel/study/build_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vessel/centreline/curve.hpp"
#include "vessel/centreline/find_tree.hpp"
#include "vessel/image/lumen_of_image.hpp"
#include "vessel/image/open_image.hpp"
#include "vessel/study/loft.hpp"
#include "vessel/study/openings.hpp"
#include "vessel/study/read_surface.hpp"
#include "vessel/surface/crossings.hpp"
#include "vessel/surface/remesh.hpp"
#include "vessel/surface/smooth.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

/// As it is in the file, through contours, or in the image, which is kept.
RawSurface given_surface(const StudyCase& study, BuiltSurface& built) {
  if (study.surface) return read_surface(*study.surface);
  if (study.contours) return surface_through(*study.contours, study.where("contours"));
  built.image = open_image(*study.image);
  LumenOfImage lumen = lumen_of(*built.image, *study.image);
  built.summary.image = lumen.summary;
  return std::move(lumen.surface);
}

void repair(Repaired& state, const StudyCase& study) {
  const RepairCase& given = study.repair;
  merge_points(state, given.merge);
  if (state.surface.triangles.empty())
    throw input_error("{}: {:.4g} cm: leaves no triangle of the surface: must be shorter than its edges",
                      study.where("repair.merge"), given.merge);
  drop_fins(state);
  keep_largest_piece(state);
  split_points(state);
  orient(state);
  remove_slivers(state, given.sliver);
  remove_crossings(state);
}

/// Of a line along the vessel, whose making takes the square of them; of a surface and within it, beyond what a run
/// could take.
constexpr double most_points = 5000, most_triangles = 2e6, most_tetrahedra = 2e7;

std::string counted(double number) {
  return std::isfinite(number) ? fmt::format("{:.3g}", number) : "countless";
}

/// Refuses lengths that would make more points than can be had, by what is known before they are made.
void check_counts(const LabelledSurface& closed, const std::vector<Rim>& rims, const StudyCase& study) {
  double apart = 0;
  for (const Rim& rim : rims)
    apart = std::max(apart, (rim.plane.origin - rims[static_cast<std::size_t>(closed.inlet)].plane.origin).norm());
  if (const double points = apart / study.centreline_spacing; points > most_points)
    throw input_error("{}: {:.4g} cm: would make a line of {} points or more: must make at most {:.0f}",
                      study.where("centreline_spacing"), study.centreline_spacing, counted(points), most_points);
  const bool by_radius = study.edges.per_radius > 0;  // all edges are made the shortest first
  const double edge = by_radius ? study.edges.shortest : study.edges.longest;
  const double triangles = total_area(closed.points, closed.triangles) / (std::sqrt(3) / 4 * edge * edge);
  if (!(triangles <= most_triangles))
    throw input_error("{}: {:.4g} cm: would make {} triangles: must make at most {:.3g}",
                      study.where(by_radius ? "edges.shortest" : "edges.longest"), edge, counted(triangles),
                      most_triangles);
  if (!study.model || !study.model->longest_edge) return;
  const double inner = *study.model->longest_edge;
  const double tetrahedra = measures_of(closed).volume / (std::sqrt(2) / 12 * inner * inner * inner);
  if (!(tetrahedra <= most_tetrahedra))
    throw input_error("{}: {:.4g} cm: would make {} tetrahedra: must make at most {:.3g}",
                      study.where("model.longest_edge"), inner, counted(tetrahedra), most_tetrahedra);
}

/// Corners of triangles lie on the lumen, the rest of them within: of a vessel with eight corners around it a tenth of
/// its section is lost, by which it resists a quarter more (by the section's square). Fewer make no tube.
constexpr double most_volume_change = 0.1;

void check_volume(double change, const StudyCase& study) {
  if (std::abs(change) <= most_volume_change) return;
  throw input_error(
      "{}: the new triangles change the lumen's volume by {:+.0f} %: must be at most {:.0f} %: choose "
      "shorter edges",
      study.where("edges"), 100 * change, 100 * most_volume_change);
}

int trunk_of(const LabelledSurface& surface, const StudyCase& study, const std::vector<Rim>& rims) {
  int largest = -1;
  for (int i = 0; i < static_cast<int>(rims.size()); ++i) {
    if (i == surface.inlet) continue;
    if (surface.openings[i] == study.trunk) return i;
    if (largest < 0 || rims[i].area > rims[largest].area) largest = i;
  }
  if (largest < 0) throw input_error("{}: a vessel has an inlet and at least one outlet", study.where("openings"));
  return largest;
}

/// Cuts the ends that are to be shorter. The trunk's line begins at the inlet; every line ends at its outlet.
bool trim(RawSurface& open, const CentrelineTree& tree, const StudyCase& study, std::vector<Vec3>& middles) {
  bool any = false;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const std::string& name = study.openings[i].first;
    const OpeningCase& opening = study.openings[i].second;
    if (opening.trim == 0) continue;
    const bool is_inlet = name == study.inlet;
    const auto branch =
        std::find_if(tree.branches.begin(), tree.branches.end(), [&](const Branch& b) { return b.name == name; });
    const Polyline& line = is_inlet ? tree.branches.front().points : branch->points;
    const double length = arc_lengths(line).back();
    if (opening.trim >= length)
      throw input_error("{}: {:.4g} cm: its vessel is {:.3g} cm long: must be shorter",
                        study.where("openings." + name + ".trim"), opening.trim, length);
    const double arc = is_inlet ? opening.trim : length - opening.trim;
    const Vec3 along = direction_at(line, arc);
    middles[i] = point_at(line, arc);
    cut_off(open, {middles[i], is_inlet ? Vec3(-along) : along});
    any = true;
  }
  return any;
}

std::vector<double> radius_at_points(const LabelledSurface& surface, const CentrelineTree& tree) {
  std::vector<double> radius;
  for (const auto& x : surface.points.colwise()) {
    double nearest = std::numeric_limits<double>::infinity(), found = 0;
    for (const Branch& branch : tree.branches)
      for (std::size_t i = 0; i < branch.points.size(); ++i)
        // by the distance from the sphere: a point of a small branch near a large trunk is the branch's
        if (const double d = std::abs((x - branch.points[i]).norm() - branch.radii[i]); d < nearest)
          nearest = d, found = branch.radii[i];
    radius.push_back(found);
  }
  return radius;
}

LabelledSurface with_new_triangles(const LabelledSurface& closed, const CentrelineTree& tree, const StudyCase& study) {
  const EdgeCase& edges = study.edges;
  try {
    return remeshed(closed, {edges.shortest, edges.longest, edges.per_radius}, radius_at_points(closed, tree));
  } catch (const PlacedError&) {
    throw;
  } catch (const InputError& error) {
    throw input_error("{}: {}", study.where("edges"), error.what());
  }
}

/// Whether a place is among the image's outermost voxels.
bool ends_at(const ImageVolume& image, const Vec3& place) {
  const Vec3 index = image.index(place), last = Vec3(image.count[0], image.count[1], image.count[2]).array() - 1;
  return std::min(index.minCoeff(), (last - index).minCoeff()) < 0.5;
}

/// Places of the rims as they were cut, areas of the caps as they came out.
std::vector<BuiltOpening> openings_of(const LabelledSurface& surface, const std::vector<Rim>& rims,
                                      const std::optional<ImageVolume>& image) {
  std::vector<BuiltOpening> openings;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    const int label = static_cast<int>(i) + 1;
    double area = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (surface.label[t] == label) area += area_vector(surface.points, surface.triangles[t]).norm();
    openings.push_back({surface.openings[i], label, rims[i].plane.origin, rims[i].plane.normal, area,
                        std::sqrt(area / std::numbers::pi), image && ends_at(*image, rims[i].plane.origin)});
  }
  return openings;
}

std::vector<BuiltBranch> branches_of(const CentrelineTree& tree) {
  std::vector<BuiltBranch> branches;
  for (const Branch& b : tree.branches)
    branches.push_back({b.name, b.parent < 0 ? "" : tree.branches[b.parent].name, arc_lengths(b.points).back(),
                        std::accumulate(b.radii.begin(), b.radii.end(), 0.0) / static_cast<double>(b.radii.size()),
                        *std::min_element(b.radii.begin(), b.radii.end())});
  return branches;
}

/// From the surface as it was given.
void build(Repaired& state, const StudyCase& study, const StepSeen& show, BuiltSurface& built) {
  repair(state, study);
  show("2_repaired", state.surface);
  std::vector<Vec3> middles = open_ends(state, study);
  built.summary.smoothing_volume_change = smooth(state.surface, study.repair.smoothing);
  show("3_opened", state.surface);
  LabelledSurface closed = capped(state.surface, middles, study);
  const std::vector<Rim> rims = rims_at(state.surface, middles);
  const int trunk = trunk_of(closed, study, rims);
  check_counts(closed, rims, study);
  built.tree = find_tree(closed, trunk, study.centreline_spacing);
  if (trim(state.surface, built.tree, study, middles)) {
    closed = capped(state.surface, middles, study);
    built.tree = find_tree(closed, trunk, study.centreline_spacing);
  }
  show("4_closed", {closed.points, closed.triangles, closed.label});
  built.surface = with_new_triangles(closed, built.tree, study);
  SurfaceSummary& summary = built.summary;
  const SurfaceMeasures before = measures_of(closed);
  summary.study = study.name, summary.file = study.file().filename().string(), summary.inlet = study.inlet;
  summary.repairs = state.notes;
  summary.surface = measures_of(built.surface);
  summary.remeshing_volume_change = summary.surface.volume / before.volume - 1;
  check_volume(summary.remeshing_volume_change, study);
  summary.remeshing_area_change = summary.surface.wall_area / before.wall_area - 1;
  summary.distance = distance_between(closed, built.surface);
  summary.openings = openings_of(built.surface, rims_at(state.surface, middles), built.image);
  summary.branches = branches_of(built.tree);
}

}  // namespace

BuiltSurface build_surface(const StudyCase& study, const StepSeen& seen, const ImageSeen& image_seen) {
  const StepSeen show = [&](const std::string& step, const RawSurface& surface) {
    if (seen) seen(step, surface);
  };
  BuiltSurface built;
  Repaired state{given_surface(study, built), {}};
  show("1_read", state.surface);
  if (built.image && image_seen) image_seen(*built.image, state.surface);
  if (built.summary.image) check_width(*built.summary.image, *study.image);
  try {
    build(state, study, show, built);
  } catch (const PlacedError& error) {
    const std::string leak = built.summary.image ? leak_of(*built.summary.image) : "";
    if (leak.empty()) throw;
    std::vector<Vec3> places = error.places;
    places.push_back(built.summary.image->door_place);
    throw PlacedError(fmt::format("{}; {}", error.what(), leak), places);
  }
  return built;
}

std::string text_of(const SurfaceSummary& s) {
  std::string text = s.study + ": the lumen of " + s.file + "\n";
  if (s.image) text += text_of(*s.image);
  for (const RepairNote& note : s.repairs) text += "  repair: " + text_of(note) + "\n";
  for (const BuiltOpening& o : s.openings)
    text += fmt::format("  {} {}: radius {:.3g} cm, at {}{}\n", o.name == s.inlet ? "inlet" : "outlet", o.name,
                        o.radius, text_of_place(o.centre), o.at_image_border ? ", where the image ends" : "");
  for (const BuiltBranch& b : s.branches)
    text += fmt::format("  line to {}: {:.3g} cm long, radius {:.3g} cm on average, {:.3g} at least\n", b.name,
                        b.length, b.mean_radius, b.least_radius);
  return text +
         fmt::format(
             "  {} triangles, edges {:.2g} cm, least angle {:.0f} degrees; volume {:.4g} cm3 (smoothing {:+.2f} %, new "
             "triangles {:+.2f} %)\n  from the surface before: 95 of 100 places within {:.2g} cm, all within {:.2g} "
             "cm\n",
             s.surface.triangles, s.surface.mean_edge, s.surface.least_angle, s.surface.volume,
             100 * s.smoothing_volume_change, 100 * s.remeshing_volume_change, s.distance.p95, s.distance.greatest);
}

}  // namespace tether
