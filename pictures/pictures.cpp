#include "pictures/pictures.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/io/pvd.hpp"
#include "common/protocol/programs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Time at which the largest of the columns that begin and end so has its largest value.
std::optional<double> time_of_peak(const CsvTable& table, const std::string& begin, const std::string& end) {
  std::optional<double> time;
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::string& column : table.columns()) {
    if (!column.starts_with(begin) || !column.ends_with(end)) continue;
    const std::vector<double> values = table.numbers(column), times = table.numbers("time");
    const auto peak = std::max_element(values.begin(), values.end());
    if (peak == values.end() || *peak <= largest) continue;
    largest = *peak;
    time = times[static_cast<std::size_t>(peak - values.begin())];
  }
  return time;
}

/// The file of the series nearest to a time, and its time.
std::optional<std::pair<double, fs::path>> nearest(const fs::path& series, double time) {
  const PvdSeries all = PvdSeries::resumed(series, std::numeric_limits<double>::infinity());
  const auto best = std::min_element(all.entries().begin(), all.entries().end(), [time](const auto& a, const auto& b) {
    return std::abs(a.first - time) < std::abs(b.first - time);
  });
  if (best == all.entries().end()) return std::nullopt;
  return std::pair{best->first, series.parent_path() / best->second};
}

}  // namespace

bool draw_picture(const fs::path& mesh, const fs::path& png, const std::vector<std::string>& options) {
  Command command{{sibling("tether_picture").string(), mesh.string(), png.string()}, {}};
  command.words.insert(command.words.end(), options.begin(), options.end());
  const ChildEnd end = capture(command);
  if (end.exit_code != 0)
    fmt::print(stderr, "{}: is not drawn: {}\n", png.string(),
               end.errors.empty() ? how_it_ended(end.exit_code) : last_line(end.errors));
  return end.exit_code == 0;
}

bool has_display_server() {
  if (const char* wanted = std::getenv("TETHER_PICTURES"); wanted != nullptr && std::string_view(wanted) == "0")
    return false;
  return capture({{"sh", "-c", "command -v Xvfb"}, {}}).exit_code == 0;
}

std::vector<std::string> draw_pictures(const fs::path& output, const UnitSystem& units) {
  if (!has_display_server()) return {};
  const CsvTable table(output / "timeseries.csv", TableOf::tether);
  std::vector<std::string> drawn;
  const auto picture = [&](const char* name, const char* series, std::optional<double> peak, const char* field,
                           double factor, const char* title, const std::vector<std::string>& more) {
    const auto shown = peak ? nearest(output / series, *peak) : std::nullopt;
    if (!shown) return;
    std::vector<std::string> options{"--field",  field,
                                     "--warp",   "displacement",
                                     "--factor", fmt::format("{}", factor),
                                     "--title",  fmt::format("{}\n{:.3f} s", title, shown->first)};
    options.insert(options.end(), more.begin(), more.end());
    if (draw_picture(shown->second, output / "plots" / name, options)) drawn.emplace_back(name);
  };
  picture("wall.png", "solid.pvd", time_of_peak(table, "interface.max_displacement", ""), "displacement",
          units.to_mm(1.0), "displacement [mm]", {});
  picture("blood.png", "fluid.pvd", time_of_peak(table, "fluid.", ".flow"), "velocity",
          100 * units.in_si(dimension::velocity), "velocity [cm/s]", {"--cut"});
  return drawn;
}

}  // namespace tether
