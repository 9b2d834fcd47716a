#include "common/base/stopped_children.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <vector>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"

namespace tether {
namespace {

std::vector<pid_t> children_of(pid_t program) {
  std::ifstream list(fmt::format("/proc/{}/task/{}/children", program, program));
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

bool are_all_stopped(const std::vector<pid_t>& processes) {
  return !processes.empty() &&
         std::all_of(processes.begin(), processes.end(), [](pid_t pid) { return status_of(pid).is_stopped; });
}

}  // namespace

StoppedChildren::StoppedChildren(pid_t program, std::string name, std::function<bool()> is_to_end)
    : program_(program),
      name_(std::move(name)),
      is_to_end_(std::move(is_to_end)),
      thread_([this] { look_now_and_then(); }) {}

StoppedChildren::~StoppedChildren() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void StoppedChildren::look_now_and_then() {
  constexpr std::chrono::seconds between_looks{1};
  constexpr double soon = 2;        // one that is stopped and let go on at once is no matter
  constexpr double long_alone = 3;  // its programs have ended: nothing is left to wait for
  double stopped = 0, alone = 0;
  bool is_told = false;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, between_looks, [this] { return is_over_; })) {
    const std::vector<pid_t> children = children_of(program_);
    stopped = are_all_stopped(children) ? stopped + between_looks.count() : 0;
    if (stopped == 0) is_told = false;
    alone = children.empty() && is_to_end_() ? alone + between_looks.count() : 0;
    if (alone >= long_alone) return void(kill(program_, SIGKILL));
    if (stopped >= soon && !is_told) {
      fmt::print(
          stderr,
          "all processes of {} (pid {}) are stopped: kill -CONT {} lets them go on, else they are ended in {:g} s "
          "(TETHER_STOPPED_LIMIT=SECONDS waits longer)\n",
          name_, program_, fmt::join(children, " "), stopped_limit());
      is_told = true;
    }
    if (stopped < soon + stopped_limit()) continue;
    fmt::print(
        stderr,
        "all processes of {} were stopped, and still are {:g} s later (TETHER_STOPPED_LIMIT=SECONDS waits longer)\n",
        name_, stopped_limit());
    were_killed_ = true;
    for (const pid_t child : children) kill(child, SIGKILL);
    return;
  }
}

}  // namespace tether
