#include "fluid/windkessels/outlets_text.hpp"

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "pictures/gnuplot.hpp"

namespace tether {
namespace {

std::string pressures_text(const FittedOutlets& result) {
  const BeatPressures& p = result.reached;
  std::string text = "  pressure [mmHg]   mean   systolic   diastolic   pulse\n";
  if (result.target_mean)
    text += fmt::format("  asked          {:>7.2f} {:>10} {:>11} {:>7.2f}\n", *result.target_mean, "", "",
                        *result.target_pulse);
  if (const auto& m = result.measured)
    text += fmt::format("  measured       {:>7.2f} {:>10.2f} {:>11.2f} {:>7.2f}\n", m->mean, m->systolic, m->diastolic,
                        m->pulse);
  return text + fmt::format("  reached        {:>7.2f} {:>10.2f} {:>11.2f} {:>7.2f}\n", p.mean, p.systolic, p.diastolic,
                            p.pulse);
}

std::string outlets_table(const FittedOutlets& result) {
  std::size_t width = 6;
  for (const FittedOutlet& one : result.outlets) width = std::max(width, one.name.size());
  std::string text = fmt::format(
      "  {:<{}}  share [%]  proximal  distal [mmHg s/ml]  compliance [ml/mmHg]  at the start [mmHg]  flow [ml/s]\n",
      "outlet", width);
  for (const FittedOutlet& one : result.outlets)
    text += fmt::format("  {:<{}} {:>10.2f} {:>9.5f} {:>19.4f} {:>21.4f} {:>20.2f}  {:.1f} ({:.1f} to {:.1f})\n",
                        one.name, width, 100 * one.flow_share, one.proximal_resistance, one.distal_resistance,
                        one.compliance, one.initial_pressure, one.mean_flow, one.least_flow, one.most_flow);
  return text;
}

std::string measured_rows(const OutletsFit& fit) {
  std::string rows = "$measured << END\n";
  for (std::size_t i = 0; i < fit.measured_times.size(); ++i)
    rows += fmt::format("{},{}\n", fit.measured_times[i], fit.measured_pressures[i]);
  return rows + "END\n";
}

std::string beat_script(const OutletsFit& fit) {
  std::string flows = "plot 'outlets.csv' using 1:2 with lines linewidth 2 linecolor 'black' title 'all'";
  for (std::size_t i = 0; i < fit.result.outlets.size(); ++i)
    flows += fmt::format(", '' using 1:{} with lines linewidth 2 title {}", 4 + 2 * i,
                         gnuplot_text(fit.result.outlets[i].name));
  const bool measured = !fit.measured_times.empty();
  return gnuplot_head(1000, 700) + (measured ? measured_rows(fit) : "") +
         "set output 'plots/outlets.png'\nset datafile separator ','\nset key inside top right\nset multiplot layout "
         "2,1\n"
         "set xlabel 'time [s]'\nset ylabel 'pressure [mmHg]'\n"
         "plot 'outlets.csv' using 1:3 with lines linewidth 2 title 'where the outlets are joined'" +
         (measured ? ", $measured using 1:2 with points pointtype 7 pointsize 0.5 title 'measured'" : "") +
         "\nset ylabel 'flow [ml/s]'\n" + flows + "\nunset multiplot\n";
}

}  // namespace

std::string text_of(const FittedOutlets& result) {
  const auto count = result.outlets.size();
  std::string text = fmt::format("{}: {} outlet{}, {:.4g} ml/s in beats of {:.4g} s\n", result.name, count,
                                 count == 1 ? "" : "s", result.mean_flow, result.period);
  text += pressures_text(result) + "\n" + outlets_table(result);
  text += fmt::format(
      "  all: {:.5g} mmHg s/ml, {:.1f} % of it proximal, {:.4g} ml/mmHg; pulse pressures from {:.4g} to {:.4g} mmHg "
      "could be reached\n",
      result.resistance, 100 * result.proximal_share, result.compliance, result.least_pulse, result.most_pulse);
  if (result.misfit) text += fmt::format("  misfit to the curve {:.2f} mmHg (root mean square)\n", *result.misfit);
  return text + fmt::format("  at the start, {:.4g} s, the vessel has {:.2f} mmHg\n", result.start,
                            result.initial_inlet_pressure);
}

void write_beat(const std::filesystem::path& file, const OutletsFit& fit) {
  std::ofstream table(file);
  table << "time [s],flow [ml/s],pressure [mmHg]";
  for (const FittedOutlet& one : fit.result.outlets)
    table << fmt::format(",{0}.flow [ml/s],{0}.stored [mmHg]", one.name);
  table << "\n";
  for (std::size_t i = 0; i < fit.beat.times.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    table << fmt::format("{:.9g},{:.9g},{:.9g}", fit.beat.times[i], fit.beat.inlet_flow[k], fit.beat.pressure[k]);
    for (Eigen::Index one = 0; one < fit.beat.flow.rows(); ++one)
      table << fmt::format(",{:.9g},{:.9g}", fit.beat.flow(one, k), fit.beat.stored(one, k));
    table << "\n";
  }
  if (!table.flush()) throw write_error(file);
}

bool draw_outlets(const std::filesystem::path& output, const OutletsFit& fit) {
  if (!has_gnuplot()) return false;
  run_gnuplot(output, "outlets.gp", beat_script(fit));
  return true;
}

}  // namespace tether
