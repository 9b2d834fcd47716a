#pragma once

#include <cstddef>

namespace tether {

/// What a group of processes takes that runs a model of so many nodes, blood and wall together [bytes]; measured on
/// meshes of 3,000 to 42,000 nodes (docs/performance.md), with a third more for measurements and what is not there.
double memory_of_group(std::size_t nodes);

/// Groups that fit into four fifths of this memory [bytes]; at least one.
std::size_t groups_within(double memory, std::size_t nodes);

/// What the machine can give to processes that start now [bytes]; infinite where it does not say.
double available_memory();

}  // namespace tether
