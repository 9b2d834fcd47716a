#include "solid/elements/wall_elements.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <span>
#include <type_traits>

#include "common/base/error.hpp"
#include "solid/elements/element_response.hpp"
#include "solid/elements/prism.hpp"
#include "solid/elements/prism_pack.hpp"
#include "solid/elements/shared_elements.hpp"
#include "solid/elements/tetrahedron.hpp"
#include "solid/materials/registry.hpp"

namespace tether {
namespace {

template <class Element>
class ElementsOf final : public WallElements {
 public:
  static constexpr int nodes = Element::nodes, samples = Element::samples, unknowns = 3 * nodes;
  using Cell = typename Element::Cell;
  using Positions = Eigen::Matrix<double, 3, nodes>;
  using Samples = Eigen::Matrix<double, samples, 1>;
  using Block = Eigen::Matrix<double, unknowns, unknowns, Eigen::RowMajor>;

  /// `number_of`: what an element is called in messages.
  template <class Number>
  ElementsOf(const std::vector<Cell>& cells, const Points& reference, const Number& number_of)
      : cells_(cells), scatter_(static_cast<int>(reference.cols()), 3, std::span<const Cell>(cells_)) {
    elements_.reserve(cells.size());
    reference_.reserve(cells.size());
    unit_.reserve(cells.size());
    unstressed_.reserve(cells.size());
    initial_.reserve(cells.size());
    initial_mean_.reserve(cells.size());
    for (std::size_t e = 0; e < cells.size(); ++e) {
      const Positions x = gather(reference, e);
      elements_.emplace_back(x);
      reference_.push_back(elements_.back().strains().products(x));
      unit_.push_back(elements_.back().strains().units(x));
      unstressed_.push_back(x);
      initial_.push_back(Samples::Zero());
      initial_mean_.push_back(Voigt::Zero());
      for (int q = 0; q < Element::points; ++q)
        if (!(elements_.back().weight(q) > 0))
          throw run_error("wall element {} at ({:.4g} {:.4g} {:.4g}) has no positive volume", number_of(e),
                          x.row(0).mean(), x.row(1).mean(), x.row(2).mean());
    }
    if constexpr (packed)
      for (std::size_t e = 0; e < cells.size(); e += Pack::width) packs_.emplace_back(four_at(e));
  }

  void static_force(const Points& x, const Material& material, VectorXd& force, SparseMatrix* tangent) const override {
    const WallLaw law(material);
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const Element& element = elements_[e];
      const Positions local = gather(x, e);
      const auto rates = element.strains().rates(local);
      const Samples s = element.strains().products(local) - reference_[e];
      if (tangent == nullptr) {
        scatter(rates * (stress_of(e, s, law) + initial_stress(e)), e, force);
        continue;
      }
      auto response = response_of(e, s, law);
      response.stress += initial_stress(e);
      scatter(rates * response.stress, e, force);
      scatter_.add(*tangent, e, block(rates, response.tangent, element.strains().geometric(response.stress)).data());
    }
  }

  void step_force(const StepMotion& motion, const WallMaterial& material, VectorXd& force,
                  SparseMatrix* tangent) const override {
    if constexpr (packed)
      if (!motion.conserve_energy && !has_fibres()) return step_force_by_packs(motion, material, force, tangent);
    const double advance = motion.theta * motion.dt;
    const WallLaw law(*material.elastic);
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const Element& element = elements_[e];
      const auto& strains = element.strains();
      const Positions start = gather(motion.start, e), velocity = gather(motion.velocity, e),
                      middle = start + advance * velocity;
      const auto rates = strains.rates(middle);
      SampleResponse<samples> response = motion.conserve_energy
                                             ? conserving(e, start, start + motion.dt * velocity, law)
                                             : at_positions(e, middle, law, tangent != nullptr);
      response.stress += initial_stress(e);
      const double thickness = local_at(e).thickness;
      Eigen::Matrix<double, samples, samples> viscous;
      if (material.viscosity > 0) {
        viscous = viscous_tangent(element, thickness * material.viscosity, law.thickness_variation);
        response.stress += viscous * (rates.transpose() * velocity.reshaped());
      }
      const Eigen::Matrix<double, nodes, nodes> mass = thickness * material.density * element.mass();
      const Positions inertia = gather(motion.acceleration, e) * mass;
      scatter(rates * response.stress + inertia.reshaped(), e, force);
      if (tangent == nullptr) continue;
      Eigen::Matrix<double, samples, samples> by_velocity = advance * response.tangent;
      if (material.viscosity > 0) by_velocity += viscous;
      scatter_.add(*tangent, e,
                   block(rates, by_velocity, advance * strains.geometric(response.stress) + mass / advance).data());
    }
  }

  VectorXd energies(const Points& x, const Material& material) const override {
    VectorXd all(static_cast<Eigen::Index>(cells_.size()));
    const WallLaw law(material);
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const Samples s = elements_[e].strains().products(gather(x, e)) - reference_[e];
      all[static_cast<Eigen::Index>(e)] = energy_of(e, s, law) + initial_stress(e).dot(s);
    }
    return all;
  }

  VectorXd volumes() const override {
    VectorXd all(static_cast<Eigen::Index>(elements_.size()));
    for (std::size_t e = 0; e < elements_.size(); ++e) all[static_cast<Eigen::Index>(e)] = elements_[e].volume();
    return all;
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> cauchy_stress(const Points& x, const Material& material) const override;
  SparseMatrix zero_matrix() const override { return scatter_.zero_matrix(); }
  void set_initial_stress(const Points& u, const Material& material) override;
  void set_places(std::vector<ElementPlace> places) override;
  void set_local(std::vector<WallLocal> regions) override;
  VectorXd tension_force(const Points& x) const override;

 private:
  static constexpr bool packed = std::is_same_v<Element, PrismElement>;  ///< four of them are computed at once

  /// Those of the pack that begins with element e: four, or those that are left.
  std::span<const Element> four_at(std::size_t e) const {
    return std::span(elements_).subspan(e, std::min<std::size_t>(Pack::width, cells_.size() - e));
  }

  bool has_fibres() const {
    return std::any_of(local_.begin(), local_.end(), [](const WallLocal& local) { return !local.fibres.empty(); });
  }

  /// `step_force` of elements without fibres, whose energy need not be conserved.
  void step_force_by_packs(const StepMotion& motion, const WallMaterial& material, VectorXd& force,
                           SparseMatrix* tangent) const {
    const WallLaw law(*material.elastic);
    const PrismPack::Step step(law, material.viscosity, material.density, motion.theta, motion.dt);
    PrismPack::Block block;
    for (std::size_t p = 0; p < packs_.size(); ++p) {
      const std::size_t first = p * Pack::width, count = four_at(first).size();
      const PrismPack::Motion moved = pack_motion(motion, first, count);
      const PrismPack::Force all =
          tangent == nullptr ? packs_[p].force(moved, step) : packs_[p].force(moved, step, block);
      for (std::size_t lane = 0; lane < count; ++lane) {
        scatter(lane_of(all, lane), first + lane, force);
        if (tangent != nullptr) scatter_.add(*tangent, first + lane, Block(lane_of(block, lane)).data());
      }
    }
  }

  /// Mean second Piola-Kirchhoff stress of all elements at nodal positions x, but for the initial one.
  Eigen::Matrix<double, 6, Eigen::Dynamic> mean_stresses(const Points& x, const WallLaw& law) const {
    Eigen::Matrix<double, 6, Eigen::Dynamic> all(6, static_cast<Eigen::Index>(cells_.size()));
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const Element& element = elements_[e];
      const PointStrains<Element> at(element, Samples(element.strains().products(gather(x, e)) - reference_[e]), law);
      all.col(static_cast<Eigen::Index>(e)) =
          local_at(e).stiffness * mean_stress(element, at.strain, law) + mean_tension(e) + mean_of_fibres(e, at.strain);
    }
    return all;
  }

  /// The same of elements without fibres.
  Eigen::Matrix<double, 6, Eigen::Dynamic> mean_stresses_by_packs(const Points& x, const WallLaw& law) const {
    Eigen::Matrix<double, 6, Eigen::Dynamic> all(6, static_cast<Eigen::Index>(cells_.size()));
    const PrismPack::Step at_rest(law, 0, 0, 1, 1);
    for (std::size_t p = 0; p < packs_.size(); ++p) {
      const std::size_t first = p * Pack::width, count = four_at(first).size();
      const PrismPack::Motion still = pack_motion({x, x, x, 1, 1, false}, first, count);
      const Eigen::Matrix<Pack, 6, 1> four = packs_[p].mean_stress(still.start, still.reference, at_rest);
      for (std::size_t lane = 0; lane < count; ++lane)
        all.col(static_cast<Eigen::Index>(first + lane)) =
            local_at(first + lane).stiffness * lane_of(four, lane) + mean_tension(first + lane);
    }
    return all;
  }

  PrismPack::Motion pack_motion(const StepMotion& motion, std::size_t first, std::size_t count) const {
    PrismPack::Motion moved;
    for (std::size_t lane = 0; lane < Pack::width; ++lane) {
      const std::size_t e = first + std::min(lane, count - 1);
      const auto at = static_cast<int>(lane);
      for (int a = 0; a < nodes; ++a) {
        const int node = cells_[e][static_cast<std::size_t>(a)];
        for (int i = 0; i < 3; ++i) {
          moved.start(i, a).set(at, motion.start(i, node));
          moved.velocity(i, a).set(at, motion.velocity(i, node));
          moved.acceleration(i, a).set(at, motion.acceleration(i, node));
        }
      }
      const Samples initial = initial_stress(e);
      for (int k = 0; k < samples; ++k) {
        moved.reference[k].set(at, reference_[e][k]);
        moved.initial[k].set(at, initial[k]);
      }
      moved.stiffness.set(at, local_at(e).stiffness);
      moved.thickness.set(at, local_at(e).thickness);
    }
    return moved;
  }

  /// One element's part of what four have.
  template <class Packed>
  static auto lane_of(const Packed& four, std::size_t lane) {
    return four.unaryExpr([lane](const Pack& x) { return x[static_cast<int>(lane)]; });
  }

  Positions gather(const Points& x, std::size_t e) const {
    Positions local;
    for (int a = 0; a < nodes; ++a) local.col(a) = x.col(cells_[e][static_cast<std::size_t>(a)]);
    return local;
  }

  void scatter(const Eigen::Matrix<double, unknowns, 1>& local, std::size_t e, VectorXd& force) const {
    for (int a = 0; a < nodes; ++a)
      force.segment<3>(3 * cells_[e][static_cast<std::size_t>(a)]) += local.template segment<3>(3 * a);
  }

  const WallLocal& local_at(std::size_t e) const {
    return local_[places_.empty() ? 0 : static_cast<std::size_t>(places_[e].zone)];
  }

  /// Factor of the law's response, and whether there is more than the law (S.19).
  static double factor_of(const WallLocal& local) { return local.stiffness * local.thickness; }

  double energy_of(std::size_t e, const Samples& s, const WallLaw& law) const {
    const double plain = sample_energy(elements_[e], s, law);
    const WallLocal& here = local_at(e);
    if (here.is_plain()) return plain;
    double sum = factor_of(here) * plain;
    for_fibres(e, [&](const Fibres& fibres, const Samples& row, double weight) {
      sum += weight * fibre_response(fibres, row.dot(s)).energy;
    });
    return sum;
  }

  Samples stress_of(std::size_t e, const Samples& s, const WallLaw& law) const {
    const Samples plain = sample_stress(elements_[e], s, law);
    const WallLocal& here = local_at(e);
    if (here.is_plain()) return plain;
    Samples sum = factor_of(here) * plain;
    for_fibres(e, [&](const Fibres& fibres, const Samples& row, double weight) {
      sum += weight * fibre_response(fibres, row.dot(s)).stress * row;
    });
    return sum;
  }

  SampleResponse<samples> response_of(std::size_t e, const Samples& s, const WallLaw& law) const {
    SampleResponse<samples> result = sample_response(elements_[e], s, law);
    const WallLocal& here = local_at(e);
    if (here.is_plain()) return result;
    result.stress *= factor_of(here);
    result.tangent *= factor_of(here);
    for_fibres(e, [&](const Fibres& fibres, const Samples& row, double weight) {
      const FibreResponse fibre = fibre_response(fibres, row.dot(s));
      result.stress += weight * fibre.stress * row;
      result.tangent += weight * fibre.tangent * row * row.transpose();
    });
    return result;
  }

  /// Calls body(fibres, row, weight) for each family at each point: its strain is row . s. Fibres lie in the element's
  /// middle surface, across which its enhanced mode strains: the two do not meet (S.20).
  template <class Body>
  void for_fibres(std::size_t e, const Body& body) const {
    const WallLocal& here = local_at(e);
    std::size_t next = 0;
    for (const Fibres& fibres : here.fibres)
      for (int family = 0; family < 2; ++family)
        for (int q = 0; q < Element::points; ++q)
          body(fibres, fibre_rows_[e][next++], here.thickness * elements_[e].weight(q));
  }

  /// What the strain along a direction a, at a point, takes from each sample: a.E a = row . s.
  Samples strain_along(std::size_t e, int q, const Vec3& a) const {
    return elements_[e].map(q, 1).transpose() * voigt_dyad(a, a).cwiseProduct(halved_shears());
  }

  Samples initial_stress(std::size_t e) const {
    if (local_at(e).tension == 0) return initial_[e];
    return initial_[e] + local_at(e).tension * tension_[e];
  }

  /// Unit directions around and along the vessel in the element's middle surface.
  struct Frame {
    Vec3 around, along;
  };
  Frame frame(std::size_t e) const {
    Vec3 normal = places_[e].outward;
    if constexpr (Element::enhanced) normal = elements_[e].thickness_direction();
    const Vec3 along = (places_[e].axial - normal.dot(places_[e].axial) * normal).normalized();
    return {along.cross(normal), along};
  }

  SampleResponse<samples> at_positions(std::size_t e, const Positions& x, const WallLaw& law, bool with_tangent) const {
    const Samples s = elements_[e].strains().products(x) - reference_[e];
    if (with_tangent) return response_of(e, s, law);
    SampleResponse<samples> result;
    result.stress = stress_of(e, s, law);
    return result;
  }

  /// Gonzalez' discrete gradient (S.6): stress' (s1 - s0) = Phi(s1) - Phi(s0) exactly; tangent: that of the mean
  /// strain, symmetric.
  SampleResponse<samples> conserving(std::size_t e, const Positions& x0, const Positions& x1,
                                     const WallLaw& law) const {
    const Element& element = elements_[e];
    const Samples s0 = element.strains().products(x0) - reference_[e],
                  s1 = element.strains().products(x1) - reference_[e];
    SampleResponse<samples> result = response_of(e, Samples(0.5 * (s0 + s1)), law);
    const Samples change = s1 - s0, scaled = change.cwiseQuotient(unit_[e].cwiseAbs2());
    const double square = change.dot(scaled);
    if (square == 0) return result;
    const double stored = square > small_change * small_change ? energy_of(e, s1, law) - energy_of(e, s0, law)
                                                               : simpson(e, s0, result.stress, s1, law);
    result.stress += (stored - result.stress.dot(change)) / square * scaled;
    return result;
  }

  /// Strains whose energies differ by too little to be subtracted: rounding over the change would drown the stress.
  static constexpr double small_change = 1e-3;

  /// Phi(s1) - Phi(s0) from the stresses at both ends and between, error O(change^5).
  double simpson(std::size_t e, const Samples& s0, const Samples& middle_stress, const Samples& s1,
                 const WallLaw& law) const {
    const Samples mean = (stress_of(e, s0, law) + 4 * middle_stress + stress_of(e, s1, law)) / 6;
    return mean.dot(s1 - s0);
  }

  static Voigt mean_stress(const Element& element, const std::array<Voigt, Element::points>& strain,
                           const WallLaw& law) {
    Voigt sum = Voigt::Zero();
    for (int q = 0; q < Element::points; ++q)
      sum += element.weight(q) / element.volume() * stress(law.material, strain[static_cast<std::size_t>(q)]);
    return sum;
  }

  static Voigt mean_along(const Vec3& direction) {
    return voigt_dyad(direction, direction).cwiseProduct(halved_shears());
  }
  /// Of the tension (S.19).
  Voigt mean_tension(std::size_t e) const {
    if (local_at(e).tension == 0) return Voigt::Zero();
    return local_at(e).tension * mean_along(frame(e).along);
  }
  /// Of the fibres (S.20).
  Voigt mean_of_fibres(std::size_t e, const std::array<Voigt, Element::points>& strain) const {
    Voigt sum = Voigt::Zero();
    if (local_at(e).fibres.empty()) return sum;
    const auto [around, along] = frame(e);
    for (const Fibres& fibres : local_at(e).fibres)
      for (const double sign : {1.0, -1.0}) {
        const Voigt direction = mean_along(std::cos(fibres.angle) * around + sign * std::sin(fibres.angle) * along);
        for (int q = 0; q < Element::points; ++q)
          sum += elements_[e].weight(q) / elements_[e].volume() *
                 fibre_response(fibres, direction.dot(strain[static_cast<std::size_t>(q)])).stress * direction;
      }
    return sum;
  }
  static Voigt halved_shears() {
    Voigt halves;
    halves << 1, 1, 1, 0.5, 0.5, 0.5;
    return halves;
  }

  static Eigen::Matrix<double, samples, samples> viscous_tangent(const Element& element, double viscosity,
                                                                 double thickness_variation) {
    Eigen::Matrix<double, samples, samples> sum = Eigen::Matrix<double, samples, samples>::Zero();
    const Voigt halves = halved_shears();  // S = eta de/dt: stress components from 2 E12 ...
    for (int q = 0; q < Element::points; ++q) {
      const auto map = element.map(q, thickness_variation);
      sum += map.transpose() * (viscosity * element.weight(q) * halves).asDiagonal() * map;
    }
    return sum;
  }

  /// B' D B, and on the diagonal of each pair of nodes' block what does not depend on the direction (geometric part,
  /// mass).
  static Block block(const typename StrainSamples<nodes, samples>::Rates& rates,
                     const Eigen::Matrix<double, samples, samples>& d,
                     const Eigen::Matrix<double, nodes, nodes>& isotropic) {
    const Eigen::Matrix<double, unknowns, samples> product = rates.lazyProduct(d);  // Eigen would pack and block these
    Block result = product.lazyProduct(rates.transpose());
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b)
        for (int i = 0; i < 3; ++i) result(3 * a + i, 3 * b + i) += isotropic(a, b);
    return result;
  }

  std::vector<Cell> cells_;
  std::vector<Element> elements_;
  std::vector<PrismPack> packs_;                  ///< of prisms
  std::vector<Samples> reference_;                ///< products at the stress-free positions
  std::vector<Samples> unit_;                     ///< samples of unit strain there
  std::vector<Samples> initial_;                  ///< initial stress, dual to the samples
  std::vector<Voigt> initial_mean_;               ///< its mean over the element
  std::vector<ElementPlace> places_;              ///< none: all in one region
  std::vector<WallLocal> local_{WallLocal{}};     ///< of each region
  std::vector<Samples> tension_;                  ///< dual to the samples, of a unit stress along the vessel
  std::vector<std::vector<Samples>> fibre_rows_;  ///< in the order of for_fibres
  std::vector<Positions> unstressed_;
  ScatterMap scatter_;
};

template <class Element>
void ElementsOf<Element>::set_initial_stress(const Points& u, const Material& material) {
  const Voigt66 C = stress_and_tangent(material, Voigt::Zero()).tangent;
  const double lambda = C(0, 1), mu = C(3, 3), sum = lambda + mu;
  const auto linear = saint_venant_kirchhoff.make(std::array{mu * (3 * lambda + 2 * mu) / sum, lambda / (2 * sum)});
  const WallLaw law(*linear);
  constexpr double small = 0.01;  // the law is linear, but a strain that no body can have would have no square root
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const Samples all = elements_[e].strains().rates(unstressed_[e]).transpose() * gather(u, e).reshaped();
    const double share = small / std::max(small, largest_strain(elements_[e], all, law));
    const Samples s = share * all;
    initial_[e] = sample_stress(elements_[e], s, law) / share;
    initial_mean_[e] = mean_stress(elements_[e], PointStrains<Element>(elements_[e], s, law).strain, law) / share;
    TETHER_ASSERT(initial_[e].allFinite(), "the initial stress of element {} is not finite: strain {}", e,
                  largest_strain(elements_[e], all, law));
  }
}

template <class Element>
void ElementsOf<Element>::set_places(std::vector<ElementPlace> places) {
  TETHER_ASSERT(places.size() == cells_.size(), "{} places for {} elements", places.size(), cells_.size());
  places_ = std::move(places);
  int last = 0;
  for (const ElementPlace& place : places_) last = std::max(last, place.zone);
  local_.assign(static_cast<std::size_t>(last) + 1, WallLocal{});
}

template <class Element>
void ElementsOf<Element>::set_local(std::vector<WallLocal> regions) {
  TETHER_ASSERT(regions.size() >= local_.size(), "{} regions of {}", regions.size(), local_.size());
  local_ = std::move(regions);
  tension_.resize(cells_.size());
  fibre_rows_.assign(cells_.size(), {});
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    if (local_at(e).tension == 0 && local_at(e).fibres.empty()) continue;
    const auto [around, along] = frame(e);
    tension_[e].setZero();
    for (int q = 0; q < Element::points; ++q) tension_[e] += elements_[e].weight(q) * strain_along(e, q, along);
    for (const Fibres& fibres : local_at(e).fibres)
      for (const double sign : {1.0, -1.0})
        for (int q = 0; q < Element::points; ++q)
          fibre_rows_[e].push_back(
              strain_along(e, q, std::cos(fibres.angle) * around + sign * std::sin(fibres.angle) * along));
  }
}

template <class Element>
VectorXd ElementsOf<Element>::tension_force(const Points& x) const {
  VectorXd force = VectorXd::Zero(x.size());
  for (std::size_t e = 0; e < cells_.size(); ++e)
    if (local_at(e).tension != 0)
      scatter(elements_[e].strains().rates(gather(x, e)) * (local_at(e).tension * tension_[e]), e, force);
  return force;
}

/// sigma = F S F'/J at each quadrature point, averaged; F from U'U = C would lose the rotation, so F comes from the
/// element's mean gradient. (S.13)
template <class Element>
Eigen::Matrix<double, 6, Eigen::Dynamic> ElementsOf<Element>::cauchy_stress(const Points& x,
                                                                            const Material& material) const {
  const WallLaw law(material);
  Eigen::Matrix<double, 6, Eigen::Dynamic> result;
  if constexpr (packed)
    result = has_fibres() ? mean_stresses(x, law) : mean_stresses_by_packs(x, law);
  else
    result = mean_stresses(x, law);
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const Mat3 f = elements_[e].mean_gradient(gather(x, e));
    const Voigt s = initial_mean_[e] + result.col(static_cast<Eigen::Index>(e));
    Mat3 tensor;
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Mat3 sigma = f * tensor * f.transpose() / f.determinant();
    result.col(static_cast<Eigen::Index>(e)) << sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2),
        sigma(0, 2);
  }
  return result;
}

template <class Element>
std::unique_ptr<WallElements> elements_of(const std::vector<typename Element::Cell>& cells, const Points& reference,
                                          const Share& share) {
  if (share.is_whole()) return std::make_unique<ElementsOf<Element>>(cells, reference, [](std::size_t e) { return e; });
  const std::vector<int> numbers = share.elements_here(cells);
  std::vector<typename Element::Cell> here;
  std::vector<char> answers;
  for (const int number : numbers) {
    here.push_back(cells[static_cast<std::size_t>(number)]);
    answers.push_back(share.answers_for(here.back()) ? 1 : 0);
  }
  std::unique_ptr<WallElements> held;
  share.team().each([&] {
    held = std::make_unique<ElementsOf<Element>>(here, reference, [&](std::size_t e) { return numbers[e]; });
  });
  return std::make_unique<SharedElements>(share, std::move(held), numbers, std::move(answers), cells.size());
}

}  // namespace

std::unique_ptr<WallElements> make_wall_elements(const WallMesh& mesh, const Points& reference, const Share& share) {
  if (!mesh.prisms.empty()) return elements_of<PrismElement>(mesh.prisms, reference, share);
  return elements_of<TetrahedronElement>(mesh.tetrahedra, reference, share);
}

std::unique_ptr<WallElements> make_wall_elements(const WallMesh& mesh, const Points& reference) {
  return make_wall_elements(mesh, reference, Share(static_cast<int>(mesh.points.cols())));
}

}  // namespace tether
