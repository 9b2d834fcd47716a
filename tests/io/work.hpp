#pragma once

#include <ctime>

namespace tether {

/// What this process has worked since; others on the machine do not count.
class Work {
 public:
  double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t begin_ = std::clock();
};

}  // namespace tether
