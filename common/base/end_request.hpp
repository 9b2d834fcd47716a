#pragma once

#include <string>

/// A wish that programs save what they have come to, and end: a scheduler tells it some minutes before it ends a job.
namespace tether {

/// In the environment of programs: the file that is there as soon as it is told.
inline constexpr const char* end_request_variable = "TETHER_END_REQUEST";

/// By a front-end, once: SIGUSR1 tells it to this process and all that it starts; whoever then still works after
/// TETHER_END_LIMIT seconds (120 if unset) is interrupted as by SIGTERM.
class EndRequests {
 public:
  EndRequests();
  ~EndRequests();
  EndRequests(const EndRequests&) = delete;
  EndRequests& operator=(const EndRequests&) = delete;
};

/// Whether it was told.
bool end_is_requested();

/// Of who ends for it.
inline constexpr const char* told_to_end = "told to save its state and end";

}  // namespace tether
