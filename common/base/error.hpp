#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace tether {

/// The user's input is wrong (case file, mesh, curve): exit code 2. The message names file:line or the object, the rule
/// and the value. It is kept as printable (name.hpp): what it quotes may be anybody's.
struct InputError : std::runtime_error {
  explicit InputError(const std::string& message);
};

/// The run failed (a step that does not converge, a mesh that breaks, a partner that died): exit code 1. Its message is
/// kept as printable, too.
struct RunError : std::runtime_error {
  explicit RunError(const std::string& message);
};

/// A program that this one started failed, and told the user why: all that is left is its exit code.
struct ToldFailure : std::runtime_error {
  explicit ToldFailure(int code) : std::runtime_error("failed (see above)"), exit_code(code) {}
  int exit_code;
};

/// A state that the program's own logic excludes. Thrown by TETHER_ASSERT.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

enum ExitCode : int { exit_done = 0, exit_run_failed = 1, exit_input_wrong = 2 };

/// throw input_error("{}: {} is negative", name, value)
template <class... Args>
InputError input_error(fmt::format_string<Args...> format, Args&&... args) {
  return InputError(fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
RunError run_error(fmt::format_string<Args...> format, Args&&... args) {
  return RunError(fmt::format(format, std::forward<Args>(args)...));
}

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const std::string& values);

}  // namespace tether

/// TETHER_ASSERT(a.size() == b.size(), "{} {}", a.size(), b.size()): stays on in release builds; not for inner loops.
#define TETHER_ASSERT(condition, ...)                                                                       \
  do {                                                                                                      \
    if (!(condition)) ::tether::assertion_failed(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)); \
  } while (false)
