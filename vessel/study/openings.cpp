#include "vessel/study/openings.hpp"

#include <algorithm>

#include "vessel/study/read_surface.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

void check_label(const RawSurface& surface, const StudyCase& study, const std::string& name, int label) {
  const std::vector<int>& ids = surface.face_id;
  if (label > 0 && std::find(ids.begin(), ids.end(), label) == ids.end())
    throw input_error("{}: no triangle of {} has the label {}", study.where("openings." + name + ".label"),
                      study.file().string(), label);
}

void take_ends_off(Repaired& state, const StudyCase& study, std::vector<Rim>& rims) {
  std::vector<int> labels;
  bool cuts = false;
  for (const auto& [name, opening] : study.openings) {
    check_label(state.surface, study, name, opening.label);
    if (opening.label > 0) labels.push_back(opening.label);
    if (opening.cut) cuts = true;
  }
  if (!labels.empty()) rims = open_labels(state.surface, labels);
  for (const auto& [name, opening] : study.openings)
    if (opening.cut) cut_off(state.surface, {opening.cut->point, opening.cut->outward.normalized()});
  if (cuts || labels.empty()) rims = rims_of(state.surface);
  if (rims.size() + labels.size() > 0) return;
  open_flat_ends(state);
  rims = rims_of(state.surface);
}

std::size_t rim_of(const std::string& name, const OpeningCase& opening, const std::vector<Rim>& rims,
                   const StudyCase& study) {
  const std::string field = "openings." + name;
  if (opening.order > static_cast<int>(rims.size()))
    throw input_error("{}: {}: the surface has {} openings", study.where(field + ".order"), opening.order, rims.size());
  if (opening.order > 0) return static_cast<std::size_t>(opening.order) - 1;
  if (opening.cut) return rim_near(rims, opening.cut->point, field);
  if (!opening.near.empty()) return rim_near(rims, Vec3(opening.near[0], opening.near[1], opening.near[2]), field);
  const auto labelled =
      std::find_if(rims.begin(), rims.end(), [&](const Rim& rim) { return rim.face_id == opening.label; });
  if (labelled == rims.end())
    throw input_error("{}: {}: its triangles close no end of the vessel", study.where(field + ".label"), opening.label);
  return static_cast<std::size_t>(labelled - rims.begin());
}

std::vector<std::size_t> named_rims(const StudyCase& study, const std::vector<Rim>& rims) {
  if (rims.empty())
    throw input_error("{}: is closed and has no flat ends: give the openings by label or cut", study.file().string());
  std::vector<std::size_t> named;
  for (const auto& [name, opening] : study.openings) {
    const std::size_t rim = rim_of(name, opening, rims, study);
    if (const auto taken = std::find(named.begin(), named.end(), rim); taken != named.end())
      throw PlacedError(fmt::format("openings.{}: is the same as {}, at {}", name,
                                    study.openings[static_cast<std::size_t>(taken - named.begin())].first,
                                    text_of_place(rims[rim].plane.origin)),
                        {rims[rim].plane.origin});
    named.push_back(rim);
  }
  return named;
}

void fill_others(Repaired& state, const std::vector<Rim>& rims, const std::vector<std::size_t>& named, double largest) {
  RepairNote note{RepairKind::holes_filled};
  for (std::size_t i = 0; i < rims.size(); ++i) {
    if (std::find(named.begin(), named.end(), i) != named.end()) continue;
    if (rims[i].radius() > largest)
      throw PlacedError(
          fmt::format("an opening of radius {:.3g} cm at {} is not among the study's openings, and larger "
                      "than repair.largest_hole, {:.3g} cm: name it, or let it be filled",
                      rims[i].radius(), text_of_place(rims[i].plane.origin), largest),
          {rims[i].plane.origin});
    fill(state.surface, rims[i], 0);
    ++note.count, note.place = rims[i].plane.origin, note.size += rims[i].area;
  }
  if (note.count > 0) state.notes.push_back(note);
}

}  // namespace

std::vector<Vec3> open_ends(Repaired& state, const StudyCase& study) {
  std::vector<Rim> rims;
  take_ends_off(state, study, rims);
  if (!rims.empty())
    check_unit(study, std::max_element(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) {
                        return a.area < b.area;
                      })->radius());
  const std::vector<std::size_t> named = named_rims(study, rims);
  fill_others(state, rims, named, study.repair.largest_hole);
  std::vector<Vec3> middles;
  for (const std::size_t rim : named) middles.push_back(rims[rim].plane.origin);
  flatten_rims(state);
  return middles;
}

std::vector<Rim> rims_at(const RawSurface& surface, const std::vector<Vec3>& middles) {
  const std::vector<Rim> rims = rims_of(surface);
  std::vector<Rim> found;
  for (const Vec3& middle : middles) found.push_back(rims[nearest_rim(rims, middle)]);
  return found;
}

LabelledSurface capped(RawSurface surface, const std::vector<Vec3>& middles, const StudyCase& study) {
  LabelledSurface result;
  std::fill(surface.face_id.begin(), surface.face_id.end(), 0);
  int label = 0;
  for (const Rim& rim : rims_at(surface, middles)) fill(surface, rim, ++label);
  for (const auto& [name, opening] : study.openings) {
    if (name == study.inlet) result.inlet = static_cast<int>(result.openings.size());
    result.openings.push_back(name);
  }
  result.points = std::move(surface.points);
  result.triangles = std::move(surface.triangles);
  result.label = std::move(surface.face_id);
  return result;
}

}  // namespace tether
