#include "fsi_master/coupling.hpp"
#include "fsi_master/iqn_ils.hpp"
#include "fsi_master/newton_krylov.hpp"
#include "fsi_master/newton_tangents.hpp"

namespace tether {

std::unique_ptr<Coupling> make_coupling(const std::string& method, FluidPartner& fluid, SolidPartner& solid,
                                        const CouplingOptions& options) {
  const bool linear_solid = solid.has_operators() || solid.has_tangent();
  if (method == "iqn_ils" || (method == "automatic" && !(fluid.has_tangent() && linear_solid)))
    return std::make_unique<IqnIls>(fluid, solid, options);
  if (!fluid.has_tangent())
    throw input_error("coupling.method: newton_krylov needs tangents, and {} announces none; use iqn_ils",
                      fluid.name());
  if (!linear_solid)
    throw input_error("coupling.method: newton_krylov needs tangents, and {} announces none; use iqn_ils",
                      solid.name());
  if (solid.has_operators()) return std::make_unique<NewtonKrylov>(fluid, solid, options);
  return std::make_unique<NewtonTangents>(fluid, solid, options);
}

}  // namespace tether
