#pragma once

namespace tether {

/// From now on Ctrl-C (SIGINT) and SIGTERM, where no run takes them, end the program with exit code 1 and say that the
/// same command goes on.
void say_when_interrupted();

}  // namespace tether
