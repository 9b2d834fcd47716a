#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solid/elements/strain_samples.hpp"
#include "solid/materials/material.hpp"

namespace tether {

/// A material as an element uses it. The thickness strain's variation over a triangle is scaled by gamma,
/// gamma^2 = mu/(4 (lambda + 2 mu)) at small strain: full resistance would lock the plane of a nearly incompressible
/// wall (ovalisation with nu = 0.499: -38 % at 24 nodes around), none would leave the thickness of single nodes free
/// (docs/decisions/0020-wall-element.md). (S.9)
struct WallLaw {
  explicit WallLaw(const Material& elastic) : material(elastic) {
    const Voigt66 c = stress_and_tangent(elastic, Voigt::Zero()).tangent;
    thickness_variation = 0.5 * std::sqrt(c(3, 3) / c(0, 0));
  }
  const Material& material;
  double thickness_variation;
};

/// What a strain of one element costs and resists, its enhanced mode eliminated: Phi(s) = min over alpha of sum_q w_q
/// W(M_q s + m_q alpha). (S.10)
template <int samples>
struct SampleResponse {
  using Values = Eigen::Matrix<double, samples, 1>;
  double energy = 0;               ///< Phi
  Values stress = Values::Zero();  ///< dPhi/ds
  Eigen::Matrix<double, samples, samples> tangent =
      Eigen::Matrix<double, samples, samples>::Zero();  ///< d2Phi/ds2, if asked for
};

/// The strains at an element's quadrature points, E_q = M_q s + m_q alpha, and what they are made of.
template <class Element>
struct PointStrains {
  PointStrains(const Element& element, const Eigen::Matrix<double, Element::samples, 1>& s, const WallLaw& law) {
    for (std::size_t q = 0; q < points; ++q) {
      map[q] = element.map(static_cast<int>(q), law.thickness_variation);
      strain[q] = map[q] * s;
    }
    if constexpr (Element::enhanced) enhance(element, law.material);
  }

  static constexpr std::size_t points = Element::points;
  std::array<typename Element::Map, points> map;
  std::array<Voigt, points> mode;  ///< of an enhanced element only
  std::array<Voigt, points> strain;

 private:
  /// The amplitude of the enhanced mode: sum_q w_q m_q' S(M_q s + m_q alpha) = 0, by Newton from alpha = 0 (S.10).
  void enhance(const Element& element, const Material& material) {
    constexpr int most = 25;
    double scale = 0, mode_size = 0;
    for (std::size_t q = 0; q < points; ++q) {
      mode[q] = element.enhanced_mode(static_cast<int>(q));
      mode_size = std::max(mode_size, mode[q].cwiseAbs().maxCoeff());
      scale = std::max(scale, strain[q].cwiseAbs().maxCoeff());
    }
    for (int iteration = 0; iteration < most; ++iteration) {
      double residual = 0, slope = 0;
      for (std::size_t q = 0; q < points; ++q) {
        const auto [force, stiffness] = along(mode[q], material, strain[q]);
        residual += element.weight(static_cast<int>(q)) * force;
        slope += element.weight(static_cast<int>(q)) * stiffness;
      }
      const double change = -residual / slope;
      for (std::size_t q = 0; q < points; ++q) strain[q] += change * mode[q];
      if (std::abs(change) * mode_size <= 1e-7 * scale || !std::isfinite(change))
        break;  // quadratic: what is left is below 1e-13
    }
  }
};

/// Of an element's quadrature points, without its enhanced mode. Samples themselves are no strains: they have the
/// squares of the element's lengths in them.
template <class Element>
double largest_strain(const Element& element, const Eigen::Matrix<double, Element::samples, 1>& s, const WallLaw& law) {
  double largest = 0;
  for (int q = 0; q < static_cast<int>(Element::points); ++q)
    largest = std::max(largest, (element.map(q, law.thickness_variation) * s).cwiseAbs().maxCoeff());
  return largest;
}

template <class Element>
double sample_energy(const Element& element, const Eigen::Matrix<double, Element::samples, 1>& s, const WallLaw& law) {
  const PointStrains<Element> at(element, s, law);
  double sum = 0;
  for (std::size_t q = 0; q < at.points; ++q)
    sum += element.weight(static_cast<int>(q)) * energy(law.material, at.strain[q]);
  return sum;
}

/// dPhi/ds: the enhanced mode adds nothing to it (its own equilibrium holds).
template <class Element>
Eigen::Matrix<double, Element::samples, 1> sample_stress(const Element& element,
                                                         const Eigen::Matrix<double, Element::samples, 1>& s,
                                                         const WallLaw& law) {
  const PointStrains<Element> at(element, s, law);
  Eigen::Matrix<double, Element::samples, 1> sum = Eigen::Matrix<double, Element::samples, 1>::Zero();
  for (std::size_t q = 0; q < at.points; ++q)
    sum += at.map[q].transpose() * (element.weight(static_cast<int>(q)) * stress(law.material, at.strain[q]));
  return sum;
}

/// dPhi/ds and d2Phi/ds2 = D_ss - D_sa D_as / D_aa (static condensation). (S.10)
template <class Element>
SampleResponse<Element::samples> sample_response(const Element& element,
                                                 const Eigen::Matrix<double, Element::samples, 1>& s,
                                                 const WallLaw& law) {
  const PointStrains<Element> at(element, s, law);
  SampleResponse<Element::samples> result;
  Eigen::Matrix<double, Element::samples, 1> coupling = Eigen::Matrix<double, Element::samples, 1>::Zero();
  double slope = 0;
  for (std::size_t q = 0; q < at.points; ++q) {
    const double weight = element.weight(static_cast<int>(q));
    const auto [stress, tangent] = stress_and_tangent(law.material, at.strain[q]);
    const Eigen::Matrix<double, 6, Element::samples> product = (weight * tangent).lazyProduct(at.map[q]);
    result.stress += at.map[q].transpose() * (weight * stress);
    result.tangent += at.map[q].transpose().lazyProduct(product);
    if constexpr (Element::enhanced) {
      coupling += product.transpose() * at.mode[q];
      slope += weight * at.mode[q].dot(tangent * at.mode[q]);
    }
  }
  if constexpr (Element::enhanced) result.tangent -= coupling * (coupling / slope).transpose();
  return result;
}

}  // namespace tether
