#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include "vessel/surface/edges.hpp"
#include "vessel/surface/rims.hpp"

namespace tether {

void fill(RawSurface& surface, const Rim& rim, int face_id) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> loop;
  const Points x = points_at(surface.points, rim.nodes);
  for (Eigen::Index i = 0; i < x.cols(); ++i) loop.emplace_back(x(0, i), x(1, i), x(2, i));
  std::vector<CGAL::Triple<int, int, int>> patch;
  // In the plane of the rim: through a Delaunay tetrahedralisation each run made other triangles.
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
      loop, std::back_inserter(patch), CGAL::parameters::use_2d_constrained_delaunay_triangulation(true));
  if (patch.size() != rim.nodes.size() - 2)
    throw PlacedError("the hole at " + text_of_place(rim.plane.origin) + " cannot be closed", {rim.plane.origin});
  for (const auto& t : patch) {  // against the loop's sense, which is the border's
    surface.triangles.push_back({rim.nodes[t.first], rim.nodes[t.third], rim.nodes[t.second]});
    surface.face_id.push_back(face_id);
  }
}

}  // namespace tether
