#include "solid/elements/prism_pack.hpp"

#include <algorithm>

namespace tether {
namespace {

using Samples = PrismPack::Samples;
using Six = Eigen::Matrix<Pack, 6, 1>;
using Sixes = Eigen::Matrix<Pack, 6, 6>;
using Tangent = Eigen::Matrix<Pack, PrismPack::samples, PrismPack::samples>;
using Rates = Eigen::Matrix<Pack, PrismPack::unknowns, PrismPack::samples>;
using At = PrismPack::Step::Point;

/// The components of a strain in the parent coordinates: 12, 13, 23 twice.
enum Parent { e11, e22, e12, e33, e13, e23 };

/// N s, for a strain frame N s; fanned: the thickness strain that the fan makes.
Six parent_strain(const At& at, const Samples& s, const Pack& fanned) {
  Six e;
  for (int k = 0; k < 3; ++k) e[k] = s[at.level + k];
  e[e33] = fanned;
  e[e13] = e[e23] = 0.0;
  for (int k = 0; k < 3; ++k) {
    e[e33] += at.edges[k] * s[6 + k];
    e[e13] += at.shears(0, k) * s[9 + k];
    e[e23] += at.shears(1, k) * s[9 + k];
  }
  return e;
}

/// sum += N' parent, without what the fan takes.
void add_stress(const At& at, const Six& parent, Samples& sum) {
  for (int k = 0; k < 3; ++k) {
    sum[at.level + k] += parent[k];
    sum[6 + k] += at.edges[k] * parent[e33];
    sum[9 + k] += at.shears(0, k) * parent[e13] + at.shears(1, k) * parent[e23];
  }
}

/// sum += N' parent N, without what the fan takes. Of other samples than those of the point's level it has none.
void add_tangent(const At& at, const Sixes& parent, Tangent& sum) {
  Eigen::Matrix<Pack, 6, 9> half;  // parent N: in the plane, thickness, shears
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 3; ++k) {
      half(i, k) = parent(i, k);
      half(i, 3 + k) = at.edges[k] * parent(i, e33);
      half(i, 6 + k) = at.shears(0, k) * parent(i, e13) + at.shears(1, k) * parent(i, e23);
    }
  for (int j = 0; j < 9; ++j) {
    const int column = j < 3 ? at.level + j : 3 + j;
    for (int k = 0; k < 3; ++k) {
      sum(at.level + k, column) += half(k, j);
      sum(6 + k, column) += at.edges[k] * half(e33, j);
      sum(9 + k, column) += at.shears(0, k) * half(e13, j) + at.shears(1, k) * half(e23, j);
    }
  }
}

/// block = rates d rates': the upper half and its mirror image.
void set_product(const Rates& rates, const Tangent& d, PrismPack::Block& block) {
  const Rates product = rates.lazyProduct(d);
  for (int i = 0; i < PrismPack::unknowns; ++i)
    for (int j = i; j < PrismPack::unknowns; ++j) {
      Pack sum = product(i, 0) * rates(j, 0);
      for (int k = 1; k < PrismPack::samples; ++k) sum += product(i, k) * rates(j, k);
      block(i, j) = block(j, i) = sum;
    }
}

}  // namespace

PrismPack::PrismPack(std::span<const PrismElement> elements) {
  for (int lane = 0; lane < Pack::width; ++lane) {
    const PrismElement& element = elements[std::min<std::size_t>(static_cast<std::size_t>(lane), elements.size() - 1)];
    const Voigt mode = voigt_dyad(element.centre_contravariant_.col(2), element.centre_contravariant_.col(2));
    for (int i = 0; i < 6; ++i) {
      mode_[i].set(lane, mode[i]);
      fan_[i].set(lane, element.fan_[i]);
    }
    for (std::size_t q = 0; q < points; ++q) {
      const auto& point = element.points_[q];
      points_[q].weight.set(lane, point.weight);
      points_[q].enhanced.set(lane, point.enhanced);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) points_[q].contravariant(i, j).set(lane, point.contravariant(i, j));
    }
  }
}

PrismPack::Step::Step(const WallLaw& wall_law, double viscosity_, double density_, double theta, double dt)
    : law(wall_law), viscosity(viscosity_), density(density_), advance(theta * dt) {
  const Vec3 mean = Vec3::Constant(1.0 / 3);
  for (int q = 0; q < points; ++q) {
    Point& point = at[static_cast<std::size_t>(q)];
    const Vec3 corners = PrismElement::triangle_shape(q);
    const double xi = corners[1], eta = corners[2];
    point.edges = mean + law.thickness_variation * (corners - mean);
    point.shears << 1 - eta, eta, -eta, xi, 1 - xi, xi;
    point.shape = PrismElement::shape(q);
    point.level = q < 3 ? 0 : 3;
  }
}

/// Columns: the Cartesian strain of each component in the parent coordinates.
PrismPack::Sixes PrismPack::frame(int point) const {
  const auto& g = points_[static_cast<std::size_t>(point)].contravariant;
  Sixes result;
  result.col(e11) = voigt_dyad(g.col(0), g.col(0));
  result.col(e22) = voigt_dyad(g.col(1), g.col(1));
  result.col(e12) = voigt_dyad(g.col(0), g.col(1));
  result.col(e33) = voigt_dyad(g.col(2), g.col(2));
  result.col(e13) = voigt_dyad(g.col(0), g.col(2));
  result.col(e23) = voigt_dyad(g.col(1), g.col(2));
  return result;
}

/// int N_a N_b dV
Eigen::Matrix<Pack, PrismPack::nodes, PrismPack::nodes> PrismPack::mass(const Step& step) const {
  Eigen::Matrix<Pack, nodes, nodes> sum;
  for (int a = 0; a < nodes; ++a)
    for (int b = a; b < nodes; ++b) {
      Pack entry = 0.0;
      for (std::size_t q = 0; q < points; ++q) entry += points_[q].weight * (step.at[q].shape[a] * step.at[q].shape[b]);
      sum(a, b) = sum(b, a) = entry;
    }
  return sum;
}

/// The amplitude of the enhanced mode (S.10), as PointStrains has it: until the last of the four is found.
void PrismPack::enhance(const WallLaw& law, std::array<Six, points>& strain) const {
  constexpr int most = 25;
  Pack scale = 0.0, largest = 0.0, size = 0.0;
  for (std::size_t q = 0; q < points; ++q) {
    largest = larger(largest, abs(points_[q].enhanced));
    for (int i = 0; i < 6; ++i) scale = larger(scale, abs(strain[q][i]));
  }
  for (int i = 0; i < 6; ++i) size = larger(size, largest * abs(mode_[i]));
  for (int iteration = 0; iteration < most; ++iteration) {
    Pack residual = 0.0, slope = 0.0;
    for (std::size_t q = 0; q < points; ++q) {
      const auto [force, stiffness] = along(mode_, law.material, strain[q]);
      const Pack share = points_[q].weight * points_[q].enhanced;
      residual += share * force;
      slope += share * points_[q].enhanced * stiffness;
    }
    const Pack change = -residual / slope;
    for (std::size_t q = 0; q < points; ++q) strain[q] += (change * points_[q].enhanced) * mode_;
    if (!any_above(abs(change) * size, 1e-7 * scale)) break;  // quadratic: what is left is below 1e-13
  }
}

/// At the points, and the frames that they were turned by.
struct PrismPack::Strains {
  std::array<Sixes, points> frame;
  std::array<Six, points> strain;
};

PrismPack::Strains PrismPack::strains_of(const Samples& s, const Step& step) const {
  const Pack fanned = fan_.dot(s.head<6>());
  Strains all;
  for (std::size_t q = 0; q < points; ++q) {
    all.frame[q] = frame(static_cast<int>(q));
    all.strain[q] = all.frame[q].lazyProduct(parent_strain(step.at[q], s, fanned));
  }
  enhance(step.law, all.strain);
  return all;
}

Eigen::Matrix<Pack, 6, 1> PrismPack::mean_stress(const Positions& x, const Samples& reference, const Step& step) const {
  const Samples s = PrismElement::strains().products(x) - reference;
  const Strains at = strains_of(s, step);
  Six sum = Six::Zero();
  Pack volume = 0.0;
  for (std::size_t q = 0; q < points; ++q) {
    sum += points_[q].weight * stress(step.law.material, at.strain[q]);
    volume += points_[q].weight;
  }
  return (1.0 / volume) * sum;
}

/// Dual to the samples: stress, and tangent by the velocity, of what resists strain and its rate.
struct PrismPack::Response {
  Samples stress = Samples::Zero();
  Tangent tangent;
};

PrismPack::Response PrismPack::respond(const Motion& motion, const Samples& s, const Samples& rate, const Step& step,
                                       bool with_tangent) const {
  const Pack elastic = motion.stiffness * motion.thickness, viscous = step.viscosity * motion.thickness;
  const Pack fanned_rate = fan_.dot(rate.head<6>());
  const auto [frames, strain] = strains_of(s, step);
  Response result;
  Samples coupling = Samples::Zero(), thickness = Samples::Zero();  // of the enhanced mode; of the parent's 33
  Pack thickness_stress = 0.0, thickness_coupling = 0.0, thickness_own = 0.0, slope = 0.0;
  if (with_tangent) result.tangent.setZero();
  for (std::size_t q = 0; q < points; ++q) {
    const At& at = step.at[q];
    const Pack& weight = points_[q].weight;
    Six stress;
    Sixes tangent;
    if (with_tangent) {
      const auto all = stress_and_tangent(step.law.material, strain[q]);
      stress = (weight * elastic) * all.stress;
      tangent = (weight * elastic * step.advance) * all.tangent;
      const Six along_mode = points_[q].enhanced * tangent.lazyProduct(mode_);
      const Six parent = frames[q].transpose().lazyProduct(along_mode);
      add_stress(at, parent, coupling);
      thickness_coupling += parent[e33];
      slope += points_[q].enhanced * mode_.dot(along_mode);
    } else {
      stress = (weight * elastic) * tether::stress(step.law.material, strain[q]);
    }
    if (step.viscosity > 0) {
      const Six flow = frames[q].lazyProduct(parent_strain(at, rate, fanned_rate));
      for (int i = 0; i < 6; ++i) {
        const Pack resistance = weight * viscous * (i < 3 ? 1.0 : 0.5);  // S = eta de/dt, of 2 E12 ...
        stress[i] += resistance * flow[i];
        if (with_tangent) tangent(i, i) += resistance;
      }
    }
    const Six parent_stress = frames[q].transpose().lazyProduct(stress);
    add_stress(at, parent_stress, result.stress);
    thickness_stress += parent_stress[e33];
    if (!with_tangent) continue;
    const Sixes turned = tangent.lazyProduct(frames[q]);
    const Sixes parent = frames[q].transpose().lazyProduct(turned);
    add_tangent(at, parent, result.tangent);
    add_stress(at, parent.col(e33), thickness);
    thickness_own += parent(e33, e33);
  }
  result.stress.head<6>() += thickness_stress * fan_;
  if (!with_tangent) return result;
  coupling.head<6>() += thickness_coupling * fan_;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      Pack& entry = result.tangent(i, j);
      entry -= coupling[i] * coupling[j] / slope;
      if (i < 6) entry += fan_[i] * thickness[j];
      if (j < 6) entry += thickness[i] * fan_[j];
      if (i < 6 && j < 6) entry += thickness_own * fan_[i] * fan_[j];
    }
  return result;
}

PrismPack::Force PrismPack::answer(const Motion& motion, const Step& step, Block* by_velocity) const {
  const auto& strains = PrismElement::strains();
  const Positions middle = motion.start + Pack(step.advance) * motion.velocity;
  const Rates rates = strains.rates(middle);
  const Samples s = strains.products(middle) - motion.reference;
  const Force velocity = motion.velocity.reshaped();
  const Samples rate = rates.transpose().lazyProduct(velocity);
  Response response = respond(motion, s, rate, step, by_velocity != nullptr);
  response.stress += motion.initial;
  const Eigen::Matrix<Pack, nodes, nodes> mass = (motion.thickness * step.density) * this->mass(step);
  const Positions inertia = motion.acceleration.lazyProduct(mass);
  Force force = rates.lazyProduct(response.stress);
  force += inertia.reshaped();
  if (by_velocity == nullptr) return force;
  set_product(rates, response.tangent, *by_velocity);
  const Eigen::Matrix<Pack, nodes, nodes> isotropic =
      Pack(step.advance) * strains.geometric(response.stress) + Pack(1 / step.advance) * mass;
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b)
      for (int i = 0; i < 3; ++i) (*by_velocity)(3 * a + i, 3 * b + i) += isotropic(a, b);
  return force;
}

}  // namespace tether
