#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "common/linalg/sparse.hpp"
#include "common/mesh/mesh.hpp"
#include "solid/supports/support.hpp"

namespace tether {

/// Displacement of the tissue to which a ring is tied, over time: the heart's motion y_b(t).
using TissueMotion = std::function<Vec3(double time)>;

/// Where a step's support is evaluated: the displacement at y0 + theta dt V and the velocity V.
struct SupportStep {
  const Points& displacement;
  const Points& velocity;
  double time;     ///< of that displacement
  double advance;  ///< theta dt: change of the displacement with V
};

/// A support on one region of the outer wall or on an end ring (S.4): int traction N_a dA, three points a triangle.
class SurfaceSupport {
 public:
  SurfaceSupport(Patch patch, Configured<Support> support, TissueMotion motion = {});

  const std::string& name() const { return patch_.name; }
  Configured<Support>& effect() { return support_; }

  /// Areas and normals are those of these positions until the next call. `pattern`: the wall's matrix.
  void place(const Points& positions);
  void attach(const SparseMatrix& pattern);

  /// force += what the support exerts on the wall; tangent, if not null, += - d force / dV.
  void add(const SupportStep& step, VectorXd& force, SparseMatrix* tangent) const;
  /// K += - d force / d displacement where nothing has moved; attach first.
  void add_stiffness(SparseMatrix& K) const;
  /// Total force on the wall [force].
  Vec3 resultant(const SupportStep& step) const;

 private:
  struct Face {
    double area;
    Vec3 normal;
  };
  SupportTraction at(const SupportStep& step, std::size_t triangle, int edge) const;

  Patch patch_;
  Configured<Support> support_;
  TissueMotion motion_;
  std::vector<Face> faces_;
  ScatterMap scatter_;
};

}  // namespace tether
