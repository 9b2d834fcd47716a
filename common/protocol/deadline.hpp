#pragma once

#include <memory>

#include "common/protocol/guard.hpp"

namespace tether::protocol {

/// Ends the job with `exit_code` if it lives longer than `limit` [s]: MPI's leave-taking hangs where another process
/// has died. Where no thread is to be had nobody looks after the time: what was computed is not lost for that.
class Deadline {
 public:
  Deadline(double limit, int exit_code);

 private:
  std::unique_ptr<Guard> guard_;
};

}  // namespace tether::protocol
