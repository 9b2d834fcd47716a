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
class SaintVenantKirchhoff final : public Material {
 public:
  explicit SaintVenantKirchhoff(std::span<const double> values) : moduli_(IsotropicModuli::from(values)) {}
  Potential potential(double i1, double i2, double) const override {
    const double mu = moduli_.shear, lambda = moduli_.bulk - 2 * mu / 3, trace = (i1 - 3) / 2;
    Potential w;
    w.energy = lambda / 2 * trace * trace + mu / 4 * (i1 * i1 - 2 * i2 - 2 * i1 + 3);
    w.first << lambda / 2 * trace + mu / 2 * (i1 - 1), -mu / 2, 0;
    w.second(0, 0) = lambda / 4 + mu / 2;
    return w;
  }

 private:
  IsotropicModuli moduli_;
};

}  // namespace

const Registered<Material> saint_venant_kirchhoff{saint_venant_kirchhoff_declaration,
                                                  [](std::span<const double> values) -> std::unique_ptr<Material> {
                                                    return std::make_unique<SaintVenantKirchhoff>(values);
                                                  }};

}  // namespace tether
