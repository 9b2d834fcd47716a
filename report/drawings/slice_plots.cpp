#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "pictures/gnuplot.hpp"
#include "report/drawings/comparison_drawings.hpp"

namespace tether {
namespace {

/// The plane with its first axis along x of the case as far as it can be, along y in a plane across x: pictures of
/// neighbouring slices look alike, and a person finds the vessel's sides.
SlicePlane turned(const SlicePlane& plane) {
  const Vec3 x = std::abs(plane.normal[0]) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 e1 = (x - x.dot(plane.normal) * plane.normal).normalized();
  const Vec3 e2 = plane.normal.cross(e1);
  // Seen from the side on which the second axis leads toward larger coordinates.
  Eigen::Index main = 0;
  e2.cwiseAbs().maxCoeff(&main);
  return {plane.origin, e1, e2[main] < 0 ? Vec3(-e2) : e2, e2[main] < 0 ? Vec3(-plane.normal) : plane.normal};
}

/// "along x [mm]", or "along (0.8, 0, 0.6) [mm]": a direction in the case's coordinates.
std::string along(const Vec3& axis) {
  Eigen::Index main = 0;
  axis.cwiseAbs().maxCoeff(&main);
  if (axis[main] > 0.99) return fmt::format("along {} [mm]", "xyz"[main]);
  const Vec3 shown = (100 * axis).array().round().matrix() / 100;
  return fmt::format("along ({:g}, {:g}, {:g}) [mm]", shown[0] + 0.0, shown[1] + 0.0, shown[2] + 0.0);  // no -0
}

/// What a picture shows [mm].
using Extent = Eigen::AlignedBox2d;

std::string row_of(const Vec3& x, const SlicePlane& plane, const UnitSystem& units, Extent& shown) {
  const Vec2 p = plane.flat(x), mm(units.to_mm(p[0]), units.to_mm(p[1]));
  shown.extend(mm);
  return fmt::format("{} {}\n", mm[0], mm[1]);
}

/// Lines in the plane's coordinates [mm], an empty line between two of them.
std::string flat(const Lines& lines, const SlicePlane& plane, const UnitSystem& units, Extent& shown) {
  std::string text;
  for (const Points& line : lines) {
    for (const auto& x : line.colwise()) text += row_of(x, plane, units, shown);
    text += "\n";
  }
  return text;
}

std::string samples_of(const SliceView& view, const ErrorRegions& regions, int region, const UnitSystem& units,
                       Extent& shown) {
  std::string text;
  for (const Sample& sample : view.samples)
    if (regions.of(sample.region) == region) text += row_of(sample.position, view.plane, units, shown);
  return text;
}

/// One panel: its data, its plot command, and where its lines are.
struct SlicePanel {
  std::string data, plot;
  Extent shown;

  void line(const std::string& name, const std::string& rows, const std::string& style) {
    if (rows.empty()) return;
    data += fmt::format("${} << end_of_rows\n{}end_of_rows\n", name, rows);
    plot += fmt::format("{}${} with {}", plot.empty() ? "plot " : ", ", name, style);
  }
};

SlicePanel panel_of(SliceView view, const std::string& suffix, const ErrorRegions& regions, const UnitSystem& units) {
  SlicePanel panel;
  view.plane = turned(view.plane);
  panel.line("imaged" + suffix, flat(view.imaged, view.plane, units, panel.shown),
             "lines dashtype 2 linecolor '#888888' title 'imaged lumen'");
  panel.line("data" + suffix, flat(view.data, view.plane, units, panel.shown),
             "lines linewidth 2 linecolor '#000000' title 'data'");
  panel.line("model" + suffix, flat(view.model, view.plane, units, panel.shown),
             "lines linewidth 2 linecolor '#d55e00' title 'model'");
  for (int r = 0; r < static_cast<int>(regions.names.size()); ++r)
    panel.line(fmt::format("region{}_{}", r, suffix), samples_of(view, regions, r, units, panel.shown),
               fmt::format("points pointtype 7 pointsize 0.8 linecolor {} title {}", r + 2,
                           gnuplot_text(regions.names[static_cast<std::size_t>(r)])));
  if (!panel.plot.empty())
    panel.plot =
        fmt::format("set xlabel '{}'\nset ylabel '{}'\n{}", along(view.plane.e1), along(view.plane.e2), panel.plot);
  return panel;
}

/// The panels of each slice by its name.
std::map<std::string, std::vector<SlicePanel>> panels_of(const SourceDiscrepancy& source, const LumenSeries& data,
                                                         const DrawnComparison& drawn) {
  std::map<std::string, std::vector<SlicePanel>> panels;
  std::vector<const Moment*> moments{worst_moment(source), fullest_moment(source)};
  if (moments[0] == moments[1]) moments.pop_back();
  for (const Moment* moment : moments)
    for (const SliceView& view : slices_at(*moment, data, drawn.lumen, drawn.run)) {
      auto& of_slice = panels[view.name];
      SlicePanel panel = panel_of(view, std::to_string(of_slice.size()), drawn.data.regions, drawn.comparison.units);
      const char* which = moments.size() == 1    ? "farthest off, largest lumen"
                          : moment == moments[0] ? "farthest off"
                                                 : "largest lumen";
      if (!panel.plot.empty())
        panel.plot =
            fmt::format("set title {}\n{}\n",
                        gnuplot_text(fmt::format("{}, {:.3f} s: {}", view.name, moment->time, which)), panel.plot);
      of_slice.push_back(std::move(panel));
    }
  return panels;
}

/// All panels of a slice show the same place, so that one sees what moved between them.
std::string common_ranges(const std::vector<SlicePanel>& panels) {
  Extent all;
  for (const SlicePanel& panel : panels) all.extend(panel.shown);
  if (all.isEmpty()) return "";
  const double margin = 0.06 * all.sizes().maxCoeff();
  return fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", all.min()[0] - margin, all.max()[0] + margin,
                     all.min()[1] - margin, all.max()[1] + margin);
}

}  // namespace

std::string file_name(const std::string& name) {
  std::string result = name;
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '.'; }, '_');
  return result;
}

std::vector<std::string> draw_slices(const DrawnComparison& drawn) {
  if (!has_gnuplot()) return {};
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < drawn.data.lumen.size(); ++i) {
    const SourceDiscrepancy& source = drawn.comparison.sources[i];
    if (source.moments.empty()) continue;
    for (const auto& [slice, panels] : panels_of(source, *drawn.data.lumen[i], drawn)) {
      const std::string name = fmt::format("contours_{}_{}", file_name(source.name), file_name(slice));
      std::string text = gnuplot_head(600 * static_cast<int>(panels.size()), 640), plots;
      for (const SlicePanel& panel : panels) text += panel.data, plots += panel.plot;
      text += common_ranges(panels);
      text += fmt::format(
          "set output 'plots/{}.png'\nset size ratio -1\nset key outside bottom center horizontal samplen 2 font "
          "',10'\nset lmargin 8\nset rmargin 4\nset bmargin 7\nset multiplot layout "
          "1,{}\n{}unset multiplot\n",
          name, panels.size(), plots);
      run_gnuplot(drawn.output, name + ".gp", text);
      pictures.push_back(name + ".png");
    }
  }
  return pictures;
}

}  // namespace tether
