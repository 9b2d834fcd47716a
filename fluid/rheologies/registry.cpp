#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {

extern const Registered<Rheology> newtonian, carreau_yasuda, casson, power_law;

std::span<const Registered<Rheology>> rheologies() {
  static const Registered<Rheology> table[] = {
      newtonian,
      carreau_yasuda,
      casson,
      power_law,
  };
  return table;
}

}  // namespace tether::fluid
