#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "common/base/units.hpp"
#include "fsi_master/statistics.hpp"

namespace tether {

/// What a person watches: one line that is rewritten on a terminal, else a line every 5 %, nothing if quiet.
class Progress {
 public:
  struct Now {
    std::int64_t step;
    double time;
    int evaluations;
    Extent pressure;      ///< of this step
    double displacement;  ///< largest of the interface
  };

  Progress(std::int64_t first_step, std::int64_t last_step, const UnitSystem& units, bool quiet);
  void show(const Now& now);
  /// A line that stays, above the one that is rewritten.
  void note(const std::string& text);
  /// Ends the line that is being rewritten, so that a message begins on its own.
  void end_line();

 private:
  std::string line(const Now& now) const;
  std::string time_left(std::int64_t step) const;

  std::int64_t first_, last_, shown_percent_ = -5;
  UnitSystem units_;
  bool quiet_, terminal_, line_open_ = false;
  std::chrono::steady_clock::time_point begun_, shown_{};
};

/// "1 h 05 min", "3 min 20 s", "12 s"
std::string duration_text(double seconds);

}  // namespace tether
