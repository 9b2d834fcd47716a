#include "solid/materials/isotropic_moduli.hpp"
#include "solid/materials/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration neo_hookean_declaration{
    .name = "neo_hookean",
    .meaning = "Rubber-like wall: isochoric neo-Hookean with a volumetric penalty",
    .place = Place::wall,
    .parameters = {young_parameter(), poisson_parameter()}};

/// W = mu/2 (I1 J^-2/3 - 3) + kappa/4 (J^2 - 1 - 2 ln J).
class NeoHookean final : public MaterialOf<NeoHookean> {
 public:
  explicit NeoHookean(std::span<const double> values) : moduli_(IsotropicModuli::from(values)) {}
  double energy(double i1, double, double j) const override {
    return isochoric_energy(moduli_.shear / 2, 0, i1, j) + volumetric_energy(moduli_.bulk, j);
  }
  template <class T>
  Derivatives<T> at(const T& i1, const T&, const T& j) const {
    Derivatives<T> w;
    add_isochoric(w, moduli_.shear / 2, 0, i1, j);
    add_volumetric(w, moduli_.bulk, j);
    return w;
  }

 private:
  IsotropicModuli moduli_;
};

}  // namespace

const Registered<Material> neo_hookean{
    neo_hookean_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Material> { return std::make_unique<NeoHookean>(values); }};

}  // namespace tether
