#include <fmt/format.h>

#include <cmath>

#include "common/io/vtp_writer.hpp"
#include "common/io/vtu_writer.hpp"
#include "pictures/pictures.hpp"
#include "report/drawings/comparison_drawings.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Writes the lumen at a moment with its signed distances, and the data as lines; the paths without their endings.
fs::path write_moment(const Moment& moment, const LumenSeries& data, const DrawnComparison& drawn,
                      const std::string& name) {
  const fs::path stem = drawn.output / "comparison" / name;
  fs::create_directories(stem.parent_path());
  write_vtu(stem.string() + ".vtu", drawn.run.positions(moment.time), {.triangles = drawn.lumen.triangles},
            {Field::scalars("signed_distance", distance_at_nodes(moment, data, drawn.run))});
  Lines lines;
  for (const SliceView& view : slices_at(moment, data, drawn.lumen, drawn.run))
    lines.insert(lines.end(), view.data.begin(), view.data.end());
  write_vtp(stem.string() + ".vtp", lines);
  return stem;
}

}  // namespace

std::vector<std::string> draw_walls(const DrawnComparison& drawn) {
  const bool can_draw = has_display_server();
  const UnitSystem& units = drawn.comparison.units;
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < drawn.data.lumen.size(); ++i) {
    const SourceDiscrepancy& source = drawn.comparison.sources[i];
    if (source.moments.empty()) continue;
    const Moment *worst = worst_moment(source), *fullest = fullest_moment(source);
    const double range = std::ceil(10 * units.to_mm(group_of_region(*worst, -1)->model.p95)) / 10;  // one scale
    for (const auto& [which, moment] : {std::pair{"worst", worst}, {"fullest", fullest}}) {
      const std::string name = fmt::format("{}_{}", file_name(source.name), which);
      const fs::path stem = write_moment(*moment, *drawn.data.lumen[i], drawn, name);
      const std::string png = "wall_" + name + ".png";
      const bool done =
          can_draw && draw_picture(stem.string() + ".vtu", drawn.output / "plots" / png,
                                   {"--field", "signed_distance", "--diverging", "--factor",
                                    fmt::format("{}", units.to_mm(1)), "--range", fmt::format("{}", -range),
                                    fmt::format("{}", range), "--lines", stem.string() + ".vtp", "--title",
                                    fmt::format("data outside\nthe model [mm]\n{:.3f} s", moment->time)});
      if (done) pictures.push_back(png);
    }
  }
  return pictures;
}

}  // namespace tether
