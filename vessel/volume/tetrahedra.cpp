#include "vessel/volume/tetrahedra.hpp"

#include <gmsh.h>

#include <algorithm>
#include <map>

#include "common/base/error.hpp"
#include "common/mesh/topology.hpp"
#include "vessel/growth/crossings.hpp"

namespace tether {

namespace {

std::string place_of(const Points& points, int node) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", points(0, node), points(1, node), points(2, node));
}

/// Every edge once in each direction, no triangle through another.
void require_closed(const LabelledSurface& surface) {
  std::map<Edge, int> uses;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge[1], edge[0]});
    if (count > 1)
      throw input_error("the surface has more than two triangles at an edge near {}, or some that look inward",
                        place_of(surface.points, edge[0]));
    if (back == uses.end())
      throw input_error("the surface is open near {}: close it, or cut the vessel there and name the opening",
                        place_of(surface.points, edge[0]));
  }
  if (const std::vector<int> crossing = crossing_triangles(surface.points, surface.triangles); !crossing.empty())
    throw input_error("the surface crosses itself near {} ({} triangles): smooth it, or cut the branch off",
                      place_of(surface.points, surface.triangles[static_cast<std::size_t>(crossing.front())][0]),
                      crossing.size());
}

/// Gmsh, begun and ended: it keeps its state to itself.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::model::add("lumen");
  }
  ~GmshSession() { gmsh::finalize(); }

  void enclose(const LabelledSurface& surface) {
    const int shell = gmsh::model::addDiscreteEntity(2);
    std::vector<std::size_t> nodes(static_cast<std::size_t>(surface.points.cols())), corners;
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = i + 1;
    gmsh::model::mesh::addNodes(2, shell, nodes,
                                {surface.points.data(), surface.points.data() + surface.points.size()});
    for (const Triangle& t : surface.triangles)
      for (const int node : t) corners.push_back(static_cast<std::size_t>(node) + 1);
    constexpr int triangle = 2;
    gmsh::model::mesh::addElementsByType(shell, triangle, {}, corners);
    gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop({shell})});
    gmsh::model::geo::synchronize();
  }

  void fill(std::optional<double> longest_edge) {
    constexpr int delaunay = 1;
    gmsh::option::setNumber("Mesh.Algorithm3D", delaunay);
    if (longest_edge) gmsh::option::setNumber("Mesh.MeshSizeMax", *longest_edge);
    gmsh::model::mesh::generate(3);
  }

  Points points() const {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused);
    Points result(3, static_cast<Eigen::Index>(*std::max_element(tags.begin(), tags.end())));
    for (std::size_t i = 0; i < tags.size(); ++i)
      result.col(static_cast<Eigen::Index>(tags[i]) - 1) = Eigen::Map<const Vec3>(coordinates.data() + 3 * i);
    return result;
  }

  std::vector<Tetrahedron> tetrahedra() const {
    constexpr int tetrahedron = 4;
    std::vector<std::size_t> unused, nodes;
    gmsh::model::mesh::getElementsByType(tetrahedron, unused, nodes);
    std::vector<Tetrahedron> result(nodes.size() / 4);
    for (std::size_t i = 0; i < nodes.size(); ++i) result[i / 4][i % 4] = static_cast<int>(nodes[i]) - 1;
    return result;
  }
};

void turn_positive(std::vector<Tetrahedron>& tetrahedra, const Points& points) {
  for (Tetrahedron& t : tetrahedra)
    if (signed_volume(points, t) < 0) std::swap(t[2], t[3]);
}

void fill(FluidMesh& fluid, const LabelledSurface& surface, std::optional<double> longest_edge) try {
  GmshSession session;
  session.enclose(surface);
  session.fill(longest_edge);
  fluid.points = session.points();
  fluid.tetrahedra = session.tetrahedra();
} catch (const std::exception& error) {
  throw input_error("the lumen cannot be filled with tetrahedra: {}", error.what());
}

/// Gmsh numbers what it makes from the surface's last node on; a node that moved or went would tear the wall off.
void require_kept(const FluidMesh& fluid, const LabelledSurface& surface) {
  const Eigen::Index count = surface.points.cols();
  if (fluid.points.cols() < count || fluid.points.leftCols(count) != surface.points || fluid.tetrahedra.empty())
    throw input_error("the lumen cannot be filled with tetrahedra that keep its surface");
  std::vector<Triangle> kept, given;
  for (const Triangle& t : boundary_triangles(fluid.tetrahedra)) kept.push_back(sorted(t));
  for (const Triangle& t : surface.triangles) given.push_back(sorted(t));
  std::sort(kept.begin(), kept.end());
  std::sort(given.begin(), given.end());
  std::vector<Triangle> lost;
  std::set_difference(given.begin(), given.end(), kept.begin(), kept.end(), std::back_inserter(lost));
  if (!lost.empty())
    throw input_error("the lumen cannot be filled with tetrahedra that keep its surface near {}",
                      place_of(surface.points, lost.front()[0]));
}

}  // namespace

FluidMesh fill_with_tetrahedra(const LabelledSurface& surface, std::optional<double> longest_edge) {
  require_closed(surface);
  FluidMesh fluid;
  fill(fluid, surface, longest_edge);
  turn_positive(fluid.tetrahedra, fluid.points);
  require_kept(fluid, surface);
  std::vector<Patch> openings;
  for (const std::string& name : surface.openings) openings.push_back({name, {}});
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const int label = surface.label[i];
    (label == 0 ? fluid.interface : openings.at(static_cast<std::size_t>(label) - 1).triangles)
        .push_back(surface.triangles[i]);
  }
  for (std::size_t i = 0; i < openings.size(); ++i)
    (static_cast<int>(i) == surface.inlet ? fluid.inlets : fluid.outlets).push_back(openings[i]);
  return fluid;
}

}  // namespace tether
