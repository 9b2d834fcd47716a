#include "common/protocol/deadline.hpp"

#include <system_error>

#include "common/protocol/job.hpp"

namespace tether::protocol {
namespace {

constexpr double asks_every = 0.5;  // [s]

}  // namespace

Deadline::Deadline(double limit, int exit_code) {
  try {
    guard_ = std::make_unique<Guard>(asks_every, [exit_code, limit](double seconds) {
      if (seconds > limit) end_job(exit_code);
    });
  } catch (const std::system_error&) {
    guard_ = nullptr;
  }
}

}  // namespace tether::protocol
