#include "fluid/inlets/inflow.hpp"

namespace tether::fluid {

extern const Registered<Inflow> flow;

std::span<const Registered<Inflow>> inflows() {
  static const Registered<Inflow> table[] = {
      flow,
  };
  return table;
}

}  // namespace tether::fluid
