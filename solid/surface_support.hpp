#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "common/linalg/share.hpp"
#include "common/mesh/mesh.hpp"
#include "solid/anchor.hpp"
#include "solid/supports/support.hpp"

namespace tether {

/// Where a step's support is evaluated: the displacement at y0 + theta dt V and the velocity V.
struct SupportStep {
  const Points& displacement;
  const Points& velocity;
  double time;                           ///< of that displacement
  double advance;                        ///< theta dt: change of the displacement with V
  const Points* acceleration = nullptr;  ///< (V - u0)/(theta dt); null: none
};

/// A support on one region of the outer wall or on an end ring (S.4): int traction N_a dA, three points a triangle or a
/// part of one.
class SurfaceSupport {
 public:
  /// `path`: of its parameters; empty: that of the region's or ring's own support.
  SurfaceSupport(Patch patch, Configured<Support> support, TissueMotion motion = {}, std::string path = {});

  const std::string& name() const { return patch_.name; }
  const std::string& path() const { return path_; }
  const std::vector<Triangle>& triangles() const { return patch_.triangles; }
  Configured<Support>& effect() { return support_; }
  const Configured<Support>& effect() const { return support_; }
  /// From now on it is tied to this tissue, beside others.
  void follow(std::shared_ptr<MovingTissue> tissue) { anchor_.tissues.push_back(std::move(tissue)); }
  const std::vector<std::shared_ptr<MovingTissue>>& tissues() const { return anchor_.tissues; }

  /// Before all that follows: of the wall's nodes, which it then needs as long as it lives. It then acts where own
  /// nodes are.
  void share_out(const Share& share);
  /// Areas and normals are those of these positions until the next call. `pattern`: the wall's matrix.
  void place(const Points& positions);
  void attach(const SparseMatrix& pattern);
  bool is_attached() const { return is_attached_; }
  /// A number at each node that grows along the vessel (S.15), for laws that use its direction; before `place`.
  void orient(std::shared_ptr<const VectorXd> place_along_vessel) { along_ = std::move(place_along_vessel); }

  /// force += what the support exerts on the wall, of a shared wall on own nodes; tangent, if not null, += - d force /
  /// dV. Nothing if it is absent.
  void add(const SupportStep& step, VectorXd& force, SparseMatrix* tangent) const;
  /// K += - d force / d displacement where nothing has moved; attach first.
  void add_stiffness(SparseMatrix& K) const;
  /// Total force on the wall [force].
  Vec3 resultant(const SupportStep& step) const;

 private:
  struct Face {
    Triangle nodes;
    Mat3 shapes;   ///< of the nodes, one a row, at the points of quadrature, one a column
    double share;  ///< of the triangle's area
    double area;
    Vec3 normal, axial;
    Mat3 corners;        ///< imaged
    bool counts = true;  ///< in the resultant: this process answers for it
  };
  SupportTraction at(const SupportStep& step, const AffineDisplacement& rest, const Face& face, int point) const;

  Patch patch_;
  Configured<Support> support_;
  Anchor anchor_;
  std::string path_;
  std::shared_ptr<const VectorXd> along_;
  std::vector<Face> faces_;  ///< of the patch's parts
  const Share* share_ = nullptr;
  bool placed_ = false, is_attached_ = false;
  ScatterMap scatter_;
};

}  // namespace tether
