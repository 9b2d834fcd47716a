#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <fstream>

namespace tether {

/// Takes no more than this beside what the process has. Not under a sanitizer, which takes much for itself.
class LessMemory {
 public:
  explicit LessMemory(std::size_t bytes) {
#ifndef __SANITIZE_ADDRESS__
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    rlimit less = before_;
    less.rlim_cur = std::min<rlim_t>(before_.rlim_cur, pages * 4096 + bytes);
    setrlimit(RLIMIT_AS, &less);
#else
    getrlimit(RLIMIT_AS, &before_);
    static_cast<void>(bytes);
#endif
  }
  ~LessMemory() {
    setrlimit(RLIMIT_AS, &before_);
  }

 private:
  rlimit before_{};
};

}  // namespace tether
