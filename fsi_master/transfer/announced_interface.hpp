#pragma once

#include "common/protocol/partner.hpp"
#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

/// The reference surface that a partner announces. Throws RunError if its numbers do not fit together.
InterfaceSurface ask_interface(protocol::Partner& partner);

}  // namespace tether
