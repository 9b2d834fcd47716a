#pragma once

#include <string>

#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// Why this process ends, for whoever finds it dead on this host: where there is no other way to tell.
void leave_last_words(const std::string& words);
/// What a process of this host has left; they are gone then. Empty: nothing.
std::string last_words_of(const Peer& peer);

}  // namespace tether::protocol
