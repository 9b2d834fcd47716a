#include "solid/materials/isotropic_moduli.hpp"
#include "solid/materials/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration mooney_rivlin_declaration{
    .name = "mooney_rivlin",
    .meaning = "Rubber-like wall with two isochoric constants; small-strain shear modulus 2 (c1 + c2)",
    .place = Place::wall,
    .parameters = {modulus_parameter("c1", "constant of the first isochoric invariant", range::positive),
                   modulus_parameter("c2", "constant of the second isochoric invariant"),
                   modulus_parameter("bulk", "bulk modulus", range::positive)}};

/// W = c1 (J1 - 3) + c2 (J2 - 3) + kappa/4 (J^2 - 1 - 2 ln J).
class MooneyRivlin final : public MaterialOf<MooneyRivlin> {
 public:
  explicit MooneyRivlin(std::span<const double> values) : c1_(values[0]), c2_(values[1]), bulk_(values[2]) {}
  double energy(double i1, double i2, double j) const override {
    return isochoric_energy(c1_, 0, i1, j) + isochoric_energy(c2_, 1, i2, j) + volumetric_energy(bulk_, j);
  }
  template <class T>
  Derivatives<T> at(const T& i1, const T& i2, const T& j) const {
    Derivatives<T> w;
    add_isochoric(w, c1_, 0, i1, j);
    add_isochoric(w, c2_, 1, i2, j);
    add_volumetric(w, bulk_, j);
    return w;
  }

 private:
  double c1_, c2_, bulk_;
};

}  // namespace

const Registered<Material> mooney_rivlin{
    mooney_rivlin_declaration,
    [](std::span<const double> values) -> std::unique_ptr<Material> { return std::make_unique<MooneyRivlin>(values); }};

}  // namespace tether
