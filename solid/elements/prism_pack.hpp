#pragma once

#include <array>
#include <span>

#include "common/linalg/pack.hpp"
#include "solid/elements/element_response.hpp"
#include "solid/elements/prism.hpp"

namespace tether {

/// Four prisms at once: what `PrismElement` and `sample_response` say clearly, arranged to cost a fraction. A strain is
/// put together from the samples in the parent coordinates, where few of them make each component, and turned from
/// there.
class PrismPack {
 public:
  static constexpr int nodes = PrismElement::nodes, samples = PrismElement::samples, points = PrismElement::points,
                       unknowns = 3 * nodes;
  using Positions = Eigen::Matrix<Pack, 3, nodes>;
  using Samples = Eigen::Matrix<Pack, samples, 1>;
  using Force = Eigen::Matrix<Pack, unknowns, 1>;
  using Block = Eigen::Matrix<Pack, unknowns, unknowns, Eigen::RowMajor>;

  /// One to four; the last stands for those that are missing.
  explicit PrismPack(std::span<const PrismElement> elements);

  /// What is the same for all elements in a step.
  struct Step {
    Step(const WallLaw& law, double viscosity, double density, double theta, double dt);
    const WallLaw& law;
    double viscosity, density, advance;  ///< see WallMaterial; advance: theta dt
    struct Point {
      Vec3 edges;                          ///< thickness strain by the three vertical edges' (S.7)
      Eigen::Matrix<double, 2, 3> shears;  ///< shears 13 and 23 by the samples 9, 10, 11
      Eigen::Matrix<double, nodes, 1> shape;
      int level;  ///< first sample of those in the plane
    };
    std::array<Point, points> at;
  };
  /// How the four move, and in what they differ.
  struct Motion {
    Positions start, velocity, acceleration;  ///< see StepMotion
    Samples reference, initial;               ///< products at the stress-free positions; initial stress
    Pack stiffness, thickness;                ///< see WallLocal
  };
  /// See WallElements::step_force.
  Force force(const Motion& motion, const Step& step) const { return answer(motion, step, nullptr); }
  Force force(const Motion& motion, const Step& step, Block& by_velocity) const {
    return answer(motion, step, &by_velocity);
  }

  /// Second Piola-Kirchhoff stress at nodal positions x, of the elastic law alone: its mean over each element.
  Eigen::Matrix<Pack, 6, 1> mean_stress(const Positions& x, const Samples& reference, const Step& step) const;

 private:
  using Six = Eigen::Matrix<Pack, 6, 1>;
  using Sixes = Eigen::Matrix<Pack, 6, 6>;
  using Tangent = Eigen::Matrix<Pack, samples, samples>;
  struct Point {
    Pack weight;
    Eigen::Matrix<Pack, 3, 3> contravariant;
    Pack enhanced;  ///< zeta J0/J
  };
  struct Response;

  Force answer(const Motion& motion, const Step& step, Block* by_velocity) const;
  Response respond(const Motion& motion, const Samples& s, const Samples& rate, const Step& step,
                   bool with_tangent) const;
  struct Strains;
  Strains strains_of(const Samples& s, const Step& step) const;
  void enhance(const WallLaw& law, std::array<Six, points>& strain) const;
  Sixes frame(int point) const;
  Eigen::Matrix<Pack, nodes, nodes> mass(const Step& step) const;

  std::array<Point, points> points_;
  Six mode_;  ///< strain of the enhanced mode, but for its zeta J0/J
  Six fan_;
};

}  // namespace tether
