#pragma once

#include <Eigen/Core>
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

/// The amplitude alpha of the enhanced mode: sum_q w_q m_q' S(M_q s + m_q alpha) = 0, by Newton from alpha = 0 (S.10).
template <class Element>
double enhanced_amplitude(const Element& element, const std::array<Voigt, Element::points>& strain,
                          const WallLaw& law) {
  constexpr int most = 25;
  double alpha = 0, scale = 0;
  for (const Voigt& e : strain) scale = std::max(scale, e.cwiseAbs().maxCoeff());
  for (int iteration = 0; iteration < most; ++iteration) {
    double residual = 0, slope = 0, mode_size = 0;
    for (int q = 0; q < Element::points; ++q) {
      const Voigt mode = element.enhanced_mode(q);
      const auto [stress, tangent] =
          stress_and_tangent(law.material, strain[static_cast<std::size_t>(q)] + alpha * mode);
      residual += element.weight(q) * mode.dot(stress);
      slope += element.weight(q) * mode.dot(tangent * mode);
      mode_size = std::max(mode_size, mode.cwiseAbs().maxCoeff());
    }
    const double change = -residual / slope;
    alpha += change;
    if (std::abs(change) * mode_size <= 1e-7 * scale || !std::isfinite(alpha))
      break;  // quadratic: what is left is below 1e-13
  }
  return alpha;
}

/// Strains at the quadrature points, enhanced mode included.
template <class Element>
std::array<Voigt, Element::points> point_strains(const Element& element,
                                                 const Eigen::Matrix<double, Element::samples, 1>& s,
                                                 const WallLaw& law) {
  std::array<Voigt, Element::points> strain;
  for (int q = 0; q < Element::points; ++q)
    strain[static_cast<std::size_t>(q)] = element.map(q, law.thickness_variation) * s;
  if constexpr (Element::enhanced) {
    const double alpha = enhanced_amplitude(element, strain, law);
    for (int q = 0; q < Element::points; ++q) strain[static_cast<std::size_t>(q)] += alpha * element.enhanced_mode(q);
  }
  return strain;
}

template <class Element>
double sample_energy(const Element& element, const Eigen::Matrix<double, Element::samples, 1>& s, const WallLaw& law) {
  const auto strain = point_strains(element, s, law);
  double sum = 0;
  for (int q = 0; q < Element::points; ++q)
    sum += element.weight(q) * energy(law.material, strain[static_cast<std::size_t>(q)]);
  return sum;
}

/// dPhi/ds: the enhanced mode adds nothing to it (its own equilibrium holds).
template <class Element>
Eigen::Matrix<double, Element::samples, 1> sample_stress(const Element& element,
                                                         const Eigen::Matrix<double, Element::samples, 1>& s,
                                                         const WallLaw& law) {
  const auto strain = point_strains(element, s, law);
  Eigen::Matrix<double, Element::samples, 1> sum = Eigen::Matrix<double, Element::samples, 1>::Zero();
  for (int q = 0; q < Element::points; ++q)
    sum += element.map(q, law.thickness_variation).transpose() *
           (element.weight(q) * stress(law.material, strain[static_cast<std::size_t>(q)]));
  return sum;
}

/// dPhi/ds and d2Phi/ds2 = D_ss - D_sa D_as / D_aa (static condensation). (S.10)
template <class Element>
SampleResponse<Element::samples> sample_response(const Element& element,
                                                 const Eigen::Matrix<double, Element::samples, 1>& s,
                                                 const WallLaw& law) {
  const auto strain = point_strains(element, s, law);
  SampleResponse<Element::samples> result;
  Eigen::Matrix<double, Element::samples, 1> coupling = Eigen::Matrix<double, Element::samples, 1>::Zero();
  double slope = 0;
  for (int q = 0; q < Element::points; ++q) {
    const auto map = element.map(q, law.thickness_variation);
    const auto [stress, tangent] = stress_and_tangent(law.material, strain[static_cast<std::size_t>(q)]);
    const Eigen::Matrix<double, 6, Element::samples> product = element.weight(q) * tangent * map;
    result.stress += map.transpose() * (element.weight(q) * stress);
    result.tangent += map.transpose() * product;
    if constexpr (Element::enhanced) {
      const Voigt mode = element.enhanced_mode(q);
      coupling += product.transpose() * mode;
      slope += element.weight(q) * mode.dot(tangent * mode);
    }
  }
  if constexpr (Element::enhanced) result.tangent -= coupling * (coupling / slope).transpose();
  return result;
}

}  // namespace tether
