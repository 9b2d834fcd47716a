#pragma once

#include <memory>
#include <span>

namespace tether {

class Fault;
using MakeFault = std::unique_ptr<Fault> (*)();

/// What data can be wrong in. Twins make faults in this order; they are taken off in the reverse one. A new fault: one
/// file, its name in the two lists of registry.cpp.
std::span<const MakeFault> data_faults();

}  // namespace tether
