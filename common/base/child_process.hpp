#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/stopped_children.hpp"

namespace tether {

/// A program to run: its path (or a name to be looked for in PATH), its arguments, and what to add to the environment.
struct Command {
  std::vector<std::string> words;
  std::vector<std::pair<std::string, std::string>> environment;
};

/// How a program ended and what it wrote.
struct ChildEnd {
  int exit_code = 0;  ///< 128 + signal if a signal ended it
  std::string output, errors;
  int handed_on = 0;  ///< of capture_in_foreground: the last signal that this process got meanwhile and handed on
};

/// "ended with 3", "was ended by signal 9 (Killed)"
std::string how_it_ended(int exit_code);

/// The last line of a text that is not empty: what a program said at its end.
std::string last_line(const std::string& text);

/// Runs a program to its end and keeps what it writes to stdout and stderr. Throws RunError if it cannot be started, or
/// is stopped by a signal for longer than `stopped_limit`, and kills it then.
ChildEnd capture(const Command& command);
/// The same of a program that has programs of its own to end: it gets the signals INT, TERM and HUP that this process
/// gets, and is waited for.
ChildEnd capture_in_foreground(const Command& command);

/// How a program ended that ran in this process's place.
struct ForegroundEnd {
  int exit_code = 0;        ///< as ChildEnd has it
  bool was_killed = false;  ///< a signal ended the program itself, not one that it ran
  int handed_on = 0;        ///< the last signal that this process got meanwhile and handed on
  bool was_still = false;   ///< all that it ran was stopped, which was told, and killed in the end
};
/// Runs a program to its end in this process's place: it writes where this process writes, reads nothing, gets the
/// signals INT, TERM and HUP that this process gets, and TERM if this process dies. One at a time.
ForegroundEnd run_in_foreground(const Command& command);

/// A program that runs beside this process: it writes where this process writes, reads nothing, and gets TERM if this
/// process or this object goes first.
class RunningProgram {
 public:
  /// Throws RunError if it cannot be started.
  explicit RunningProgram(const Command& command);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Its exit code, as ChildEnd has it; nothing as long as it runs.
  std::optional<int> exit_code();
  /// Waits for that.
  int wait();

 private:
  std::string name_;
  pid_t pid_;
  StoppedChildren children_;
  std::optional<int> code_;
};

}  // namespace tether
