#include "solid/materials/isotropic_moduli.hpp"
#include "solid/materials/registry.hpp"

namespace tether {
namespace {

const EffectDeclaration ciarlet_geymonat_declaration{
    .name = "ciarlet_geymonat",
    .meaning = "The aortic wall of Moireau et al. 2012: two isochoric constants and a logarithmic volume term",
    .place = Place::wall,
    .parameters = {modulus_parameter("k1", "constant of the first isochoric invariant", range::positive),
                   modulus_parameter("k2", "constant of the second isochoric invariant"),
                   modulus_parameter("bulk", "bulk modulus", range::positive)}};

/// W = k1 (J1 - 3) + k2 (J2 - 3) + k (J - 1) - k ln J.
class CiarletGeymonat final : public MaterialOf<CiarletGeymonat> {
 public:
  explicit CiarletGeymonat(std::span<const double> values) : k1_(values[0]), k2_(values[1]), bulk_(values[2]) {}
  double energy(double i1, double i2, double j) const override {
    return isochoric_energy(k1_, 0, i1, j) + isochoric_energy(k2_, 1, i2, j) + bulk_ * (j - 1 - std::log(j));
  }
  template <class T>
  Derivatives<T> at(const T& i1, const T& i2, const T& j) const {
    Derivatives<T> w;
    add_isochoric(w, k1_, 0, i1, j);
    add_isochoric(w, k2_, 1, i2, j);
    const T inverse = 1.0 / j;
    w.first[2] += bulk_ * (1.0 - inverse);
    w.second(2, 2) += bulk_ * inverse * inverse;
    return w;
  }

 private:
  double k1_, k2_, bulk_;
};

}  // namespace

const Registered<Material> ciarlet_geymonat{ciarlet_geymonat_declaration,
                                            [](std::span<const double> values) -> std::unique_ptr<Material> {
                                              return std::make_unique<CiarletGeymonat>(values);
                                            }};

}  // namespace tether
