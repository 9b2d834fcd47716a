#include "solid/materials/isotropic_moduli.hpp"
#include "solid/materials/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration saint_venant_kirchhoff_declaration{
    .name = "saint_venant_kirchhoff",
    .meaning = "Linear elasticity in the Green-Lagrange strain; for moderate strains only",
    .place = Place::wall,
    .parameters = {young_parameter(), poisson_parameter()}};

/// W = lambda/2 tr(E)^2 + mu tr(E^2), tr E = (I1 - 3)/2, tr E^2 = (I1^2 - 2 I2 - 2 I1 + 3)/4.
class SaintVenantKirchhoff final : public MaterialOf<SaintVenantKirchhoff> {
 public:
  explicit SaintVenantKirchhoff(std::span<const double> values) {
    const IsotropicModuli moduli = IsotropicModuli::from(values);
    mu_ = moduli.shear;
    lambda_ = moduli.bulk - 2 * mu_ / 3;
  }
  double energy(double i1, double i2, double) const override {
    const double trace = (i1 - 3) / 2;
    return lambda_ / 2 * trace * trace + mu_ / 4 * (i1 * i1 - 2 * i2 - 2 * i1 + 3);
  }
  template <class T>
  Derivatives<T> at(const T& i1, const T&, const T&) const {
    Derivatives<T> w;
    w.first << lambda_ / 4 * (i1 - 3.0) + mu_ / 2 * (i1 - 1.0), -mu_ / 2, 0.0;
    w.second(0, 0) = lambda_ / 4 + mu_ / 2;
    return w;
  }

 private:
  double mu_ = 0, lambda_ = 0;
};

}  // namespace

const Registered<Material> saint_venant_kirchhoff{saint_venant_kirchhoff_declaration,
                                                  [](std::span<const double> values) -> std::unique_ptr<Material> {
                                                    return std::make_unique<SaintVenantKirchhoff>(values);
                                                  }};

}  // namespace tether
