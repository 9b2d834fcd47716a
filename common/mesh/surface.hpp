#pragma once

#include <vector>

#include "common/base/types.hpp"

/// Geometry of triangulated surfaces.
namespace tether {

/// Normal times area of a triangle [length^2].
Vec3 area_vector(const Points& points, const Triangle& triangle);

/// Sum of the area vectors: zero for a closed surface, area times normal for a flat one [length^2].
Vec3 total_area_vector(const Points& points, const std::vector<Triangle>& triangles);

double total_area(const Points& points, const std::vector<Triangle>& triangles);

/// A third of each triangle's area to each of its nodes; one value a point of `points` [length^2].
VectorXd nodal_areas(const Points& points, const std::vector<Triangle>& triangles);

/// Area-weighted mean position.
Vec3 centroid(const Points& points, const std::vector<Triangle>& triangles);

/// Unit normals at the nodes that the triangles use, weighted by the triangles' angles (Baerentzen and Aanaes 2005);
/// one column a point of `points`, zero where no triangle is.
Points nodal_normals(const Points& points, const std::vector<Triangle>& triangles);

/// Barycentric coordinates of the point of triangle (a, b, c) closest to p.
Vec3 closest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A plane through `origin` with unit `normal`.
struct Plane {
  Vec3 origin, normal;
};
/// The plane through a closed loop of points: their mean, and the loop's area vector as normal (right-handed about it).
Plane plane_of_loop(const Points& loop);

}  // namespace tether
