#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tether {

/// What a person watches: one line that is rewritten on a terminal, else a line every 5 %, nothing if quiet.
class ProgressLine {
 public:
  ProgressLine(std::int64_t first_step, std::int64_t last_step, bool quiet);

  /// "[####....] step 3/10  left 12 s  TEXT"
  void show(std::int64_t step, const std::string& text);
  /// A line that stays, above the one that is rewritten.
  void note(const std::string& text);
  /// Ends the line that is being rewritten, so that a message begins on its own.
  void end_line();

 private:
  std::string line(std::int64_t step, const std::string& text) const;

  std::int64_t first_, last_, shown_percent_ = -5;
  bool quiet_, terminal_, line_open_ = false;
  std::chrono::steady_clock::time_point begun_, shown_{};
};

/// "1 h 05 min", "3 min 20 s", "12 s"
std::string duration_text(double seconds);

double seconds_since(std::chrono::steady_clock::time_point moment);

}  // namespace tether
