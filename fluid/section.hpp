#pragma once

#include <string>
#include <vector>

#include "fluid/fluid_domain.hpp"
#include "fluid/settings.hpp"

namespace tether::fluid {

/// Where a plane cuts one tetrahedron. The integral of a linear field over it is its value at the centroid times area.
struct CutElement {
  int element = 0;
  double area = 0;
  Eigen::Vector4d centroid = Eigen::Vector4d::Zero();  ///< barycentric
  Eigen::Vector4d height = Eigen::Vector4d::Zero();    ///< of the nodes over the plane, along its normal [length]
  bool is_clipped = false;                             ///< by the radius
  double distance = 0;                                 ///< from the section's point
};

/// The connected part of a plane's cut through the lumen that holds the section's point, or is nearest to it.
struct SectionCut {
  std::vector<CutElement> elements;  ///< in ascending order
  bool is_complete = true;           ///< it ends at the wall all around, nowhere at the radius
};

/// The fields at the end of a step, on the mesh as it stands in that step.
struct EndOfStep {
  const FluidDomain& domain;
  const Points& points;    ///< of all nodes
  const Points& velocity;  ///< v~
  const VectorXd& pressure;
  double dt_over_rho;
  const Points& wall_velocity;  ///< V, with which the domain's Sigma stands in the middle of the step
};

/// A plane across the blood, fixed in space, where flow and mean pressure are reported.
class Section {
 public:
  /// The normal need not have the length 1.
  Section(std::string name, const SectionPlane& plane);

  const std::string& name() const { return name_; }
  const Vec3& normal() const { return plane_.normal; }

  /// In the mesh whose nodes stand at `points`. A node in the plane counts as beyond it. Throws InputError if the plane
  /// misses the lumen, or the part leaves it through an inlet or outlet.
  SectionCut cut(const FluidMesh& mesh, const Points& points) const;

  /// Mean of a nodal field.
  static double mean(const SectionCut& cut, const FluidMesh& mesh, const VectorXd& field);
  /// Along the normal, in space [volume/time]: that of (F.17) if the cut is complete, else the integral of v.
  double flow(const SectionCut& cut, const EndOfStep& end) const;
  /// int v.n, v = v~ - (dt/rho) grad p, which is solenoidal only as a whole: it differs from (F.17) by the error of v.
  double integral_of_velocity(const SectionCut& cut, const EndOfStep& end) const;

 private:
  std::string name_;
  SectionPlane plane_;
};

/// Throws InputError if the plane misses the lumen, the point lies outside it, or an end is cut.
Section place_section(const std::string& name, const SectionPlane& plane, const FluidMesh& mesh);

}  // namespace tether::fluid
