#include "vessel/disc.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {

int Disc::Ring::node(int place) const {
  place %= count;
  return first + (place % 2 == 0 ? place / 2 : (count + 1) / 2 + place / 2);
}

std::vector<int> Disc::flipped() const {
  std::vector<int> number(static_cast<std::size_t>(node_count()));
  std::iota(number.begin(), number.end(), 0);
  const Ring& rim = rings.back();
  for (int place = 0; place < rim.count; ++place)
    number[static_cast<std::size_t>(rim.node(place))] = rim.node(place + 1);
  return number;
}

namespace {

/// Thickness of the boundary layers over the rim's radius, from the core outward.
std::vector<double> layer_thickness(const DiscSettings& settings) {
  std::vector<double> thickness(static_cast<std::size_t>(settings.boundary_layers));
  double h = 2.0 * std::numbers::pi / settings.around;
  for (double& t : thickness) t = h *= settings.boundary_layer_ratio;
  return thickness;
}

void add_ring(Disc& disc, int count, double radius) {
  const int first = disc.rings.empty() ? 0 : disc.node_count();
  disc.rings.push_back({first, count, radius});
}

/// Rings of the core with counts that fall toward the centre, then the boundary layers with as many nodes as the rim.
void add_rings(Disc& disc, const DiscSettings& settings) {
  const std::vector<double> layers = layer_thickness(settings);
  const double core = 1.0 - std::accumulate(layers.begin(), layers.end(), 0.0);
  if (core < 0.2)
    throw input_error(
        "mesh: {} boundary layers of ratio {} leave {:.0f} % of the radius to the core: at least 20 % are needed",
        settings.boundary_layers, settings.boundary_layer_ratio, 100 * core);
  const double h = 2.0 * std::numbers::pi / settings.around;
  const int core_rings = std::max(1, static_cast<int>(std::lround(core / h)));
  add_ring(disc, 1, 0.0);
  for (int k = 1; k <= core_rings; ++k) {
    const int even = 2 * static_cast<int>(std::lround(0.5 * settings.around * k / core_rings));
    add_ring(disc, std::clamp(even, 6, settings.around), core * k / core_rings);
  }
  double radius = core;
  for (const double t : layers) add_ring(disc, settings.around, radius += t);
  disc.rings.back().radius = 1.0;
}

/// Triangles between two rings: step along the one whose next diagonal spans the smaller angle, in turn where both are
/// equal.
void fill_annulus(Disc& disc, const Disc::Ring& inner, const Disc::Ring& outer) {
  for (int i = 0, o = 0; i < inner.count || o < outer.count;) {
    const int span_outer = std::abs((o + 1) * inner.count - i * outer.count);
    const int span_inner = std::abs((i + 1) * outer.count - o * inner.count);
    const bool outward = span_outer != span_inner ? span_outer < span_inner : o % 2 == 0;
    if (i == inner.count || (o < outer.count && outward)) {
      disc.triangles.push_back({inner.node(i), outer.node(o), outer.node(o + 1)});
      ++o;
    } else {
      disc.triangles.push_back({inner.node(i), outer.node(o), inner.node(i + 1)});
      ++i;
    }
  }
}

void fill_centre(Disc& disc) {
  const Disc::Ring& ring = disc.rings[1];
  for (int i = 0; i < ring.count; ++i) disc.triangles.push_back({0, ring.node(i), ring.node(i + 1)});
}

}  // namespace

Disc make_disc(const DiscSettings& settings) {
  if (settings.around < 8 || settings.around % 2 != 0)
    throw input_error("mesh: around is {}: must be even and at least 8", settings.around);
  Disc disc;
  add_rings(disc, settings);
  fill_centre(disc);
  for (std::size_t k = 1; k + 1 < disc.rings.size(); ++k) fill_annulus(disc, disc.rings[k], disc.rings[k + 1]);
  return disc;
}

}  // namespace tether
