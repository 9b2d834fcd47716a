#pragma once

#include <optional>

#include "common/base/child_process.hpp"

namespace tether {

/// An X server without a screen (Xvfb) that lives as long as this, or this process; DISPLAY is set to it.
class DisplayServer {
 public:
  /// Throws RunError if Xvfb is not installed, or it is not ready within `start_limit`.
  DisplayServer();

 private:
  std::optional<RunningProgram> server_;
};

}  // namespace tether
