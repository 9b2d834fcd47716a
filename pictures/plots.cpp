#include "pictures/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "common/base/csv.hpp"
#include "pictures/gnuplot.hpp"

namespace tether {
namespace {

/// One picture: the columns whose names begin and end so, each drawn as a line.
struct Plot {
  const char *file, *title, *begin, *end;
  Dimension dimension;
  const char* unit;  ///< shown; empty for a number
};

constexpr std::array plots{
    Plot{"pressures.png", "Pressure", "fluid.", "pressure", dimension::pressure, "mmHg"},
    Plot{"flows.png", "Flow", "fluid.", ".flow", dimension::flow, "ml/s"},
    Plot{"displacements.png", "Displacement of points", "point.", ".displacement_length", dimension::length, "mm"},
    Plot{"largest_displacement.png", "Largest displacement of the lumen", "interface.max_displacement", "",
         dimension::length, "mm"},
    Plot{"support_forces.png", "Magnitude of the force of the support on the wall", "solid.support.", ".force_x",
         dimension::force, "N"},
    Plot{"coupling.png", "Coupling: evaluations a step", "coupling.evaluations", "", dimension::none, ""},
};

/// What a number of the case's units is multiplied by to be in the plot's.
double factor(const Plot& plot, const UnitSystem& units) {
  if (plot.dimension == dimension::pressure) return units.to_mmhg(1.0);
  if (plot.dimension == dimension::flow) return units.to_ml_per_s(1.0);
  if (plot.dimension == dimension::length) return units.to_mm(1.0);
  return units.in_si(plot.dimension);
}

/// "fluid.outlet.flow" in the plot of "fluid." and ".flow" is "outlet".
std::optional<std::string> label(const Plot& plot, const std::string& column) {
  const std::string_view begin = plot.begin, end = plot.end;
  if (!column.starts_with(begin) || !column.ends_with(end)) return std::nullopt;
  const std::string inner = column.substr(begin.size(), column.size() - begin.size() - end.size());
  return inner.empty() || inner == "." ? column : inner.substr(0, inner.find_last_not_of("._") + 1);
}

/// The table's pressures are relative to that of the image; the plots' are not.
double offset(const Plot& plot, const UnitSystem& units, double image_pressure) {
  return plot.dimension == dimension::pressure ? units.to_mmhg(image_pressure) : 0.0;
}

/// The column's value in gnuplot's words; of the x component of a vector its magnitude.
std::string value_of(const CsvTable& table, std::size_t column) {
  const std::string& name = table.columns()[column];
  if (!name.ends_with("_x")) return fmt::format("${}", column + 1);
  const auto number = [&](const char* axis) {
    const auto found =
        std::find(table.columns().begin(), table.columns().end(), name.substr(0, name.size() - 1) + axis);
    return found - table.columns().begin() + 1;
  };
  return fmt::format("sqrt(${}**2 + ${}**2 + ${}**2)", column + 1, number("y"), number("z"));
}

/// Colours are eight; behind them the lines are dashed.
std::string look_of(int line) {
  constexpr int colours = 8;
  return fmt::format("linewidth 2 linecolor {} dashtype {}", line % colours + 1, line / colours + 1);
}

std::string lines_of(const Plot& plot, const CsvTable& table, const UnitSystem& units, double image_pressure) {
  const std::string unit = plot.dimension == dimension::none ? "" : units.symbol(plot.dimension);
  std::string lines;
  int count = 0;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const auto name = label(plot, table.columns()[i]);
    if (!name || table.units()[i] != unit) continue;
    lines += fmt::format("{}'timeseries.csv' using 1:({}*{} + {}) with lines {} title {}",
                         lines.empty() ? "plot " : ", \\\n     ", value_of(table, i), factor(plot, units),
                         offset(plot, units, image_pressure), look_of(count++), gnuplot_text(*name));
  }
  return lines;
}

/// The whole script, and the pictures it draws.
std::pair<std::string, std::vector<std::string>> script(const CsvTable& table, const UnitSystem& units,
                                                        double image_pressure) {
  std::string text =
      gnuplot_head(1000, 600) + "set datafile separator ','\nset key outside right\nset xlabel 'time [s]'\n";
  std::vector<std::string> pictures;
  for (const auto& plot : plots) {
    const std::string lines = lines_of(plot, table, units, image_pressure);
    if (lines.empty()) continue;
    const std::string unit = *plot.unit ? fmt::format(" [{}]", plot.unit) : "";
    text += fmt::format("\nset output 'plots/{}'\nset title '{}'\nset ylabel '{}{}'\n{}\n", plot.file, plot.title,
                        plot.title, unit, lines);
    pictures.emplace_back(plot.file);
  }
  return {text, pictures};
}

}  // namespace

std::vector<std::string> draw_plots(const std::filesystem::path& output, const UnitSystem& units,
                                    double image_pressure) {
  if (!has_gnuplot()) return {};
  const auto [text, pictures] = script(CsvTable(output / "timeseries.csv", TableOf::tether), units, image_pressure);
  run_gnuplot(output, "plots.gp", text);
  return pictures;
}

}  // namespace tether
