#pragma once

#include <vector>

#include "common/protocol/partner.hpp"

/// How the conformance check drives a partner without knowing what it is: a fluid by interface velocities, a solid by
/// loads.
namespace tether::protocol {

using Numbers = std::vector<double>;

/// a x + b y
Numbers combined(double a, const Numbers& x, double b, const Numbers& y);
double dot(const Numbers& x, const Numbers& y);
double largest(const Numbers& x);
/// Largest difference, relative to the largest entry of either.
double difference(const Numbers& x, const Numbers& y);

/// Geometry of an interface as far as the checks need it.
struct Shape {
  explicit Shape(const Interface& surface);
  Numbers area_vectors;    ///< per node: a third of its triangles' normals times area
  double size = 0;         ///< diagonal of the bounding box
  double outwardness = 0;  ///< sum of (x - mean x) . n over the surface / (size * area): positive if n points outward
};

/// For each triangle a place within: behind its middle by a twentieth of its size.
Numbers beneath(const Interface& surface);

/// Time steps of one partner under a smooth excitation that moves the interface by about 1e-4 of its size in a step.
class Excitation {
 public:
  Excitation(Partner& partner, const Interface& surface, double dt);

  void begin();
  /// The response (forces; or displacement, then velocity) to `amplitude` times the excitation, plus `change` times
  /// another.
  Numbers evaluate(double amplitude, double change = 0);
  /// The change of the response, per unit of `change`.
  Numbers tangent();
  StepReport end(bool accepted);
  /// Chooses the solid's load so that it moves as it should.
  void calibrate();
  /// The excitation itself: a load or a velocity.
  Numbers excitation(double amplitude, double change = 0) const;

 private:
  /// How far the solid moves in a step; undefined if it fails.
  double motion();
  bool is_fluid() const { return partner_.role() == "fluid"; }

  Partner& partner_;
  double dt_, target_;
  std::int64_t step_ = 0;
  Numbers first_, second_;              // two independent smooth excitations
  Numbers displacement_, last_motion_;  // of the interface: at the start of the step, at its end by the last evaluation
};

}  // namespace tether::protocol
