#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <fstream>

#include "tests/sanitizers/built_with.hpp"

namespace tether {

/// Takes no more than this beside what the process has. Not under a sanitizer, which takes much for itself.
class LessMemory {
 public:
  explicit LessMemory(std::size_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    if (with_address_sanitizer) return;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit less = before_;
    less.rlim_cur = std::min<rlim_t>(before_.rlim_cur, pages * 4096 + bytes);
    setrlimit(RLIMIT_AS, &less);
  }
  ~LessMemory() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

}  // namespace tether
