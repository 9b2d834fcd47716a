#include <fmt/format.h>

#include <cmath>

#include "pictures/gnuplot.hpp"
#include "report/drawings/comparison_drawings.hpp"

namespace tether {
namespace {

/// Columns of a region's data: time, model's and data's own rms, model's and data's own mean, bound of the mean.
std::string rows(const SourceDiscrepancy& source, int region, bool held_out, const UnitSystem& units) {
  const double limit = judge(source, held_out).limit;
  std::string text;
  for (const Moment& moment : source.moments) {
    const Group* group = group_of_region(moment, region);
    if (moment.held_out != held_out || group->model.used() == 0) continue;
    const double bound = source.noise.deviation > 0 ? limit * source.noise.deviation / std::sqrt(group->effective) : 0;
    text += fmt::format("{}", moment.time);
    for (const double length : {group->model.rms, group->apparent.rms, group->model.mean, group->apparent.mean, bound})
      text += fmt::format(" {}", units.to_mm(length));
    text += "\n";
  }
  return text;
}

std::string block(const std::string& name, const std::string& rows) {
  return fmt::format("${} << end_of_rows\n{}end_of_rows\n", name, rows);
}

struct DistancePanel {
  const char* title;
  int model, apparent;
};

std::string panel(const DistancePanel& p, const std::string& region, const std::string& names, bool has_held_out,
                  double noise, double bound) {
  std::string text = fmt::format("set title {}\nplot ", gnuplot_text(region + ": " + p.title));
  if (p.model == 4 && bound > 0)
    text += fmt::format(
        "$training{0} using 1:(-$6):6 with filledcurves fillcolor '#dddddd' title 'what noise allows', ", names);
  if (p.model == 2 && noise > 0) text += fmt::format("{} with lines linecolor '#888888' title 'noise', ", noise);
  text += fmt::format(
      "$training{0} using 1:{1} with lines linewidth 2 dashtype 2 linecolor '#0072b2' title \"data's own motion\", "
      "$training{0} using 1:{2} with linespoints linewidth 2 pointtype 7 pointsize 0.7 linecolor '#d55e00' title "
      "'model to data'",
      names, p.apparent, p.model);
  if (has_held_out)
    text += fmt::format(
        ", $held_out{} using 1:{} with points pointtype 4 pointsize 1.4 linecolor '#000000' title "
        "'held out'",
        names, p.model);
  return text + "\n";
}

std::string script(const SourceDiscrepancy& source, const std::string& png, const UnitSystem& units) {
  const int regions = static_cast<int>(source.regions.size());
  std::string text = gnuplot_head(1200, 260 * (regions + 1)), panels;
  const double noise = units.to_mm(source.noise.deviation);
  for (int region = -1; region < regions; ++region) {
    const std::string number = std::to_string(region + 1), held_out = rows(source, region, true, units),
                      training = rows(source, region, false, units);
    if (training.empty()) continue;
    text += block("training" + number, training);
    if (!held_out.empty()) text += block("held_out" + number, held_out);
    for (const DistancePanel& p :
         {DistancePanel{"root mean square [mm]", 2, 3}, DistancePanel{"mean signed distance [mm]", 4, 5}})
      panels += panel(p, region_name(source, region), number, !held_out.empty(), noise, noise);
    panels += "unset key\nset offsets 0, 0, graph 0.05, 0\n";  // one legend is enough
  }
  return text +
         fmt::format(
             "set output 'plots/{}'\nset key top right maxrows 2\nset offsets 0, 0, graph 0.4, 0\nset autoscale "
             "xfix\nset xlabel 'time "
             "[s]'\nset multiplot layout {},2\n",
             png, regions + 1) +
         panels + "unset multiplot\n";
}

std::string script(const TraceDiscrepancy& trace, const std::string& png, const UnitSystem& units) {
  const auto [factor, unit] = shown_in(trace.unit, units);
  std::string rows;
  for (std::size_t i = 0; i < trace.times.size(); ++i)
    rows += fmt::format("{} {} {}\n", trace.times[i], factor * trace.measured[i], factor * trace.model[i]);
  return gnuplot_head(1000, 600) + block("rows", rows) +
         fmt::format(
             "set output 'plots/{}'\nset xlabel 'time [s]'\nset ylabel {}\nset title {}\n"
             "plot $rows using 1:2 with points pointtype 7 title 'measured', $rows using 1:3 with lines "
             "linewidth 2 title 'model'\n",
             png, gnuplot_text(fmt::format("{} [{}]", trace.observable, unit)), gnuplot_text(trace.name));
}

/// Rows of one kind: time, rms of the difference, of the measured velocity [m/s].
std::string rows(const VelocityDiscrepancy& velocity, bool held_out, double metres) {
  std::string text;
  for (const VelocityMoment& moment : velocity.moments)
    if (moment.held_out == held_out && moment.found.used > 0)
      text += fmt::format("{} {} {}\n", moment.time, metres * moment.found.rms, metres * moment.found.measured);
  return text;
}

std::string script(const VelocityDiscrepancy& velocity, const std::string& png, const UnitSystem& units) {
  const double metres = units.in_si(dimension::velocity);
  const std::string held_out = rows(velocity, true, metres);
  std::string text = gnuplot_head(1000, 600) + block("training", rows(velocity, false, metres));
  if (!held_out.empty()) text += block("held_out", held_out);
  text += fmt::format(
      "set output 'plots/{}'\nset xlabel 'time [s]'\nset ylabel 'velocity, root mean square [m/s]'\nset title {}\n"
      "set yrange [0:*]\nplot $training using 1:3 with linespoints dashtype 2 title 'measured', "
      "$training using 1:2 with linespoints linewidth 2 pointtype 7 title 'measured minus model'",
      png, gnuplot_text(velocity.name));
  if (!held_out.empty()) text += ", $held_out using 1:2 with points pointtype 4 pointsize 1.4 title 'held out'";
  return text + "\n";
}

}  // namespace

std::vector<std::string> draw_distances(const DrawnComparison& drawn) {
  if (!has_gnuplot()) return {};
  std::vector<std::string> pictures;
  for (const SourceDiscrepancy& source : drawn.comparison.sources) {
    if (source.moments.empty()) continue;
    const std::string name = "comparison_" + file_name(source.name);
    run_gnuplot(drawn.output, name + ".gp", script(source, name + ".png", drawn.comparison.units));
    pictures.push_back(name + ".png");
  }
  for (const TraceDiscrepancy& trace : drawn.comparison.traces) {
    if (trace.times.empty()) continue;
    const std::string name = "trace_" + file_name(trace.name);
    run_gnuplot(drawn.output, name + ".gp", script(trace, name + ".png", drawn.comparison.units));
    pictures.push_back(name + ".png");
  }
  for (const VelocityDiscrepancy& velocity : drawn.comparison.velocities) {
    if (velocity.training.used == 0) continue;
    const std::string name = "velocity_" + file_name(velocity.name);
    run_gnuplot(drawn.output, name + ".gp", script(velocity, name + ".png", drawn.comparison.units));
    pictures.push_back(name + ".png");
  }
  return pictures;
}

}  // namespace tether
