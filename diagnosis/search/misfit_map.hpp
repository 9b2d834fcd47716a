#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/whitening.hpp"
#include "diagnosis/results/located_misfit.hpp"
#include "diagnosis/search/trained.hpp"

namespace tether {

/// Where on the lumen data and model differ, by patches instead of regions: bumps of three sizes at many places, each
/// constant and with the first harmonic of the run. (D.24)
class MisfitMap {
 public:
  /// problem: whitened; start, end: of the run [time].
  MisfitMap(const Evidence& evidence, const Whitening& whitening, const EffectProblem& problem, double start,
            double end);

  /// The patch that explains most of what is left [k] of the whitened data; none where no data lie on the lumen. Its
  /// unit is left empty.
  std::optional<LocatedMisfit> worst(const VectorXd& left) const;
  /// How significant (z) a patch of that size is about each of these places.
  VectorXd significance(const Points& places, double radius, const VectorXd& left) const;

 private:
  struct Patch {
    double gain = 0;
    Vec3 amplitudes = Vec3::Zero();  ///< constant, cosine, sine [length]
  };
  /// About each of these places.
  std::vector<Patch> patches(const Points& about, double radius, const VectorXd& left) const;
  /// Of a bump at the data [n].
  VectorXd bump(const Vec3& centre, double radius) const;
  double phase(double time) const;
  void set_greatest(LocatedMisfit& found, const Vec3& amplitudes) const;
  void set_regions(LocatedMisfit& found) const;

  const Evidence& evidence_;
  const Whitening& whitening_;
  Trained trained_;
  double start_, duration_;
  std::vector<Eigen::Index> rows_;  ///< of data on the lumen
  std::vector<double> times_;       ///< of the frames
  Points places_;                   ///< of those of the frame with the most
  MatrixXd waves_;                  ///< 1, cosine, sine at the data's times [n x 3]
  double smallest_ = 0;             ///< radius
};

}  // namespace tether
