#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {

extern const Registered<Rheology> newtonian, carreau_yasuda, casson, power_law, shear_thinning;

std::span<const Registered<Rheology>> rheologies() {
  static const Registered<Rheology> table[] = {
      newtonian, carreau_yasuda, casson, power_law, shear_thinning,
  };
  return table;
}

}  // namespace tether::fluid
