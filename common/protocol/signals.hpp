#pragma once

#include "common/base/error.hpp"

/// SIGINT and SIGTERM: from a person, a scheduler, or from mpirun one second before it kills everybody because one
/// process of the job died. A handler of the host code is left alone.
namespace tether::protocol {

/// This process was told to end.
struct Interrupted : RunError {
  explicit Interrupted(const std::string& what = "interrupted") : RunError(what) {}
};

/// A master: its next wait ends with PeerDied or Interrupted, so that it can say what happened. A second signal kills
/// it.
void report_signals();
bool interrupted();
/// Throws Interrupted half a second after the signal: until then a partner may tell of a death that came before it.
void check_interrupted();

/// A partner: such a signal takes effect after one second, so that its master does not mistake it for the process that
/// died; a partner that is a master too uses that second to say what happened.
void delay_termination();

}  // namespace tether::protocol
