#include "vessel/ring/ring_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "pictures/gnuplot.hpp"

namespace tether {

std::string text_of(const TrackedRing& ring) {
  const auto [thin, wide] = std::minmax_element(
      ring.poses.begin(), ring.poses.end(), [](const RingPose& a, const RingPose& b) { return a.radius < b.radius; });
  const auto crooked = std::max_element(ring.poses.begin(), ring.poses.end(),
                                        [](const RingPose& a, const RingPose& b) { return a.off_plane < b.off_plane; });
  std::string text =
      fmt::format("{}: {} frames, the ring's centre goes {:.3g} cm at most, its plane tilts by {:.1f} degrees\n",
                  ring.name, ring.poses.size(), ring.largest_way, ring.largest_tilt);
  text += fmt::format("  radius {:.3g} to {:.3g} cm; off its plane by {:.2g} cm at most\n", thin->radius, wide->radius,
                      crooked->off_plane);
  if (!ring.turns_about_axis) text += "  no landmark: a turn about the ring's own axis is not seen\n";
  return text;
}

void write_poses(const std::filesystem::path& file, const TrackedRing& ring) {
  std::ofstream table(file);
  table << "time [s],x [cm],y [cm],z [cm],turn_x [rad],turn_y [rad],turn_z [rad],radius [cm]\n";
  for (const RingPose& pose : ring.poses)
    table << fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", pose.time, pose.centre[0],
                         pose.centre[1], pose.centre[2], pose.turn[0], pose.turn[1], pose.turn[2], pose.radius);
  if (!table.flush()) throw write_error(file);
}

bool draw_ring(const std::filesystem::path& output) {
  if (!has_gnuplot()) return false;
  const auto curves = [](int first, const char* scale) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
      text +=
          fmt::format("{} using 1:((column({}){}){}) with linespoints linewidth 2 pointtype 7 pointsize 0.6 title '{}'",
                      axis == 0 ? "plot 'poses.csv'" : ", ''", first + axis,
                      fmt::format("-start[{}]", first + axis - 1), scale, "xyz"[axis]);
    return text;
  };
  run_gnuplot(
      output, "ring.gp",
      gnuplot_head(1000, 800) +
          "set datafile separator ','\narray start[6]\n"
          "do for [i=1:6] { stats 'poses.csv' using i+1 every ::1::1 nooutput; start[i] = STATS_min }\n"
          "set output 'plots/ring.png'\nset key outside right\nset multiplot layout 2,1\nset xlabel 'time [s]'\n"
          "set ylabel 'way of the centre [mm]'\n" +
          curves(2, "*10") + "\nset ylabel 'turn [degrees]'\n" + curves(5, "*180/pi") + "\nunset multiplot\n");
  return true;
}

}  // namespace tether
