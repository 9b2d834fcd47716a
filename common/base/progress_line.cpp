#include "common/base/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace tether {
namespace {

constexpr int bar_width = 20;
constexpr double refresh_interval = 0.1;  // seconds between two lines on a terminal

/// mpirun gives its processes a terminal of its own, so isatty says nothing there: whoever calls mpirun may tell by
/// TETHER_PROGRESS (bar or lines) whether a person looks.
bool on_terminal() {
  if (const char* told = std::getenv("TETHER_PROGRESS")) return std::string_view(told) == "bar";
  return std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && isatty(STDOUT_FILENO) == 1;
}

/// A line that is longer would wrap, and could not be rewritten.
std::size_t terminal_width() {
  const char* told = std::getenv("COLUMNS");
  const int columns = told ? std::atoi(told) : 0;
  return columns > 20 ? static_cast<std::size_t>(columns) : 120;
}

}  // namespace

double seconds_since(std::chrono::steady_clock::time_point moment) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - moment).count();
}

std::string duration_text(double seconds) {
  const long total = std::lround(seconds);
  if (total >= 3600) return fmt::format("{} h {:02} min", total / 3600, total % 3600 / 60);
  if (total >= 60) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} s", total);
}

ProgressLine::ProgressLine(std::int64_t first_step, std::int64_t last_step, bool quiet)
    : first_(first_step),
      last_(last_step),
      quiet_(quiet),
      terminal_(on_terminal()),
      begun_(std::chrono::steady_clock::now()) {}

std::string ProgressLine::line(std::int64_t step, const std::string& text) const {
  const std::int64_t filled = bar_width * step / std::max<std::int64_t>(last_, 1);
  const auto done = static_cast<double>(step - first_), open = static_cast<double>(last_ - step);
  const std::string left = duration_text(seconds_since(begun_) / std::max(done, 1.0) * open);
  return fmt::format("[{:#<{}}{:.<{}}] step {}/{}  left {}  {}", "", filled, "", bar_width - filled, step, last_, left,
                     text);
}

void ProgressLine::show(std::int64_t step, const std::string& text) {
  if (quiet_) return;
  const bool last = step == last_;
  const std::int64_t percent = 100 * step / std::max<std::int64_t>(last_, 1);
  if (terminal_ && (last || seconds_since(shown_) > refresh_interval)) {
    fmt::print("\r{}\033[K", line(step, text).substr(0, terminal_width() - 1));
    line_open_ = true;
    shown_ = std::chrono::steady_clock::now();
    if (last) end_line();
  } else if (!terminal_ && (last || percent >= shown_percent_ + 5)) {
    fmt::print("{}\n", line(step, text));
    shown_percent_ = percent - percent % 5;
  }
  std::fflush(stdout);
}

void ProgressLine::note(const std::string& text) {
  if (quiet_) return;
  end_line();
  fmt::print("{}\n", text);
}

void ProgressLine::end_line() {
  if (line_open_) fmt::print("\n");
  line_open_ = false;
  std::fflush(stdout);
}

}  // namespace tether
