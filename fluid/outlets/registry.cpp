#include "fluid/outlets/outlet.hpp"

namespace tether::fluid {

extern const Registered<Outlet> windkessel, resistance, prescribed_pressure;

std::span<const Registered<Outlet>> outlets() {
  static const Registered<Outlet> table[] = {
      windkessel,
      resistance,
      prescribed_pressure,
  };
  return table;
}

}  // namespace tether::fluid
