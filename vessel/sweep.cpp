#include "vessel/sweep.hpp"

#include <cmath>

#include "common/base/error.hpp"
#include "common/mesh/topology.hpp"
#include "vessel/extrude.hpp"
#include "vessel/polar_curve.hpp"

namespace tether {

namespace {

/// A point of the rim between its nodes, linearly; angle as fraction of the full turn.
Vec3 rim_point(const CrossSection& section, double turn) {
  const auto around = static_cast<double>(section.rim.cols());
  const double place = turn * around, floor = std::floor(place);
  const auto node = static_cast<Eigen::Index>(floor) % section.rim.cols();
  const double t = place - floor;
  return (1 - t) * section.rim.col(node) + t * section.rim.col((node + 1) % section.rim.cols());
}

/// Node numbers of the vessel: discs behind each other, every other one flipped.
class Numbering {
 public:
  explicit Numbering(const Disc& disc) : nodes_(disc.node_count()), flipped_(disc.flipped()) {}
  int operator()(int node, int level) const {
    return level * nodes_ + (level % 2 == 0 ? node : flipped_[static_cast<std::size_t>(node)]);
  }
  Triangle operator()(const Triangle& t, int level) const {
    return {(*this)(t[0], level), (*this)(t[1], level), (*this)(t[2], level)};
  }

 private:
  int nodes_;
  std::vector<int> flipped_;
};

/// The disc's nodes in all cross-sections.
Points placed(const Disc& disc, const std::vector<CrossSection>& sections, const Numbering& number) {
  const int levels = static_cast<int>(sections.size());
  Points points(3, disc.node_count() * levels);
  for (int level = 0; level < levels; ++level) {
    const CrossSection& section = sections[static_cast<std::size_t>(level)];
    for (const Disc::Ring& ring : disc.rings)
      for (int i = 0; i < ring.count; ++i)
        points.col(number(ring.node(i), level)) =
            section.centre + ring.radius * (rim_point(section, double(i) / ring.count) - section.centre);
  }
  return points;
}

std::vector<Prism> prisms_between_sections(const Disc& disc, int along, const Numbering& number) {
  std::vector<Prism> prisms;
  for (int i = 0; i < along; ++i)
    for (const Triangle& t : disc.triangles) {
      const Triangle b = number(t, i), a = number(t, i + 1);
      prisms.push_back({b[0], b[1], b[2], a[0], a[1], a[2]});
    }
  return prisms;
}

std::vector<Triangle> interface_triangles(const Disc& disc, int along, const Numbering& number) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < disc.rim().count; ++j) {
      const int a = disc.rim().node(j), b = disc.rim().node(j + 1);
      for (const Triangle& half : split_quadrilateral(number(a, i), number(b, i), number(b, i + 1), number(a, i + 1)))
        triangles.push_back(half);
    }
  return triangles;
}

void require_positive_volumes(const FluidMesh& fluid) {
  for (const Tetrahedron& tetrahedron : fluid.tetrahedra)
    if (const Vec3 at = fluid.points.col(tetrahedron[0]); !(signed_volume(fluid.points, tetrahedron) > 0))
      throw input_error(
          "mesh: the swept lumen folds near ({:.4g}, {:.4g}, {:.4g}): cross-sections are too close, too oblique or out "
          "of order",
          at[0], at[1], at[2]);
}

FluidMesh fill(const Disc& disc, const std::vector<CrossSection>& sections) {
  const int along = static_cast<int>(sections.size()) - 1;
  const Numbering number(disc);
  FluidMesh fluid;
  fluid.points = placed(disc, sections, number);
  fluid.tetrahedra = split_into_tetrahedra(prisms_between_sections(disc, along, number));
  fluid.interface = interface_triangles(disc, along, number);
  Patch inlet{"inlet", {}}, outlet{"outlet", {}};
  for (const Triangle& t : disc.triangles) {
    inlet.triangles.push_back({t[0], t[2], t[1]});
    outlet.triangles.push_back(number(t, along));
  }
  fluid.inlets = {inlet};
  fluid.outlets = {outlet};
  require_positive_volumes(fluid);
  return fluid;
}

/// Angle and position of a node of the wall, from the cross-section it stands in.
WallPlace place_on_vessel(int node, const Disc& disc, int along) {
  const int around = disc.rim().count, interface_nodes = around * (along + 1);
  const int on_interface = node % interface_nodes, in_ring = on_interface % around;
  const int level = on_interface / around, half = around / 2;
  const int place = 2 * (in_ring % half) + in_ring / half - level % 2;  // undoes Disc::Ring::node and flipping
  return {360.0 * ((place + around) % around) / around, static_cast<double>(level) / along};
}

}  // namespace

VesselMesh sweep(const SweepSettings& settings) {
  const Disc disc = make_disc(settings.disc);
  VesselMesh vessel;
  vessel.fluid = fill(disc, cross_sections(settings));
  vessel.wall = extrude_wall(vessel.fluid, {settings.wall_thickness, settings.layers});
  if (!settings.regions.empty())
    vessel.wall.outside =
        divide_by_regions(vessel.wall.outside.front().triangles, settings.regions, settings.regions_field,
                          [&](int node) { return place_on_vessel(node, disc, settings.along); });
  return vessel;
}

std::vector<Points> circular_tube_sections(double radius, double length, int around) {
  std::vector<Points> sections;
  for (const double z : {0.0, length})
    sections.push_back(circle(make_frame({0, 0, z}, {0, 0, 1}, {1, 0, 0}), radius, 4 * around));
  return sections;
}

SweepSettings circular_tube_settings(double radius, double length, double thickness, int around, int along,
                                     int layers) {
  SweepSettings settings;
  settings.sections = circular_tube_sections(radius, length, around);
  settings.wall_thickness = thickness;
  settings.along = along;
  settings.layers = layers;
  settings.disc.around = around;
  return settings;
}

VesselMesh circular_tube(double radius, double length, double thickness, int around, int along, int layers) {
  return sweep(circular_tube_settings(radius, length, thickness, around, along, layers));
}

}  // namespace tether
