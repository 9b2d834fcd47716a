#include "pictures/display_server.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/base/error.hpp"
#include "common/base/limits.hpp"

namespace tether {
namespace {

/// A pipe that programs inherit.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_.data()) != 0) throw run_error("no pipe: {}", std::strerror(errno));
  }
  ~Pipe() {
    close(ends_[0]);
    close_write_end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int write_end() const { return ends_[1]; }
  void close_write_end() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }
  /// Up to the end of a line, of the file, or the time [s].
  std::string line(double limit) const {
    std::string text;
    pollfd ready{ends_[0], POLLIN, 0};
    for (char c = 0; poll(&ready, 1, static_cast<int>(1000 * limit)) > 0 && read(ends_[0], &c, 1) == 1 && c != '\n';)
      text += c;
    return text;
  }

 private:
  std::array<int, 2> ends_{};
};

/// With a number of its own: of two servers that look for a free one, the first takes the socket of the second away
/// when it ends in that moment.
Command server(const Pipe& number) {
  constexpr int first = 100, numbers = 50000;  // a display's number is below 59536
  return {{"sh", "-c", "exec Xvfb \":$1\" -displayfd \"$0\" -screen 0 1280x1024x24 -nolisten tcp >/dev/null 2>&1",
           std::to_string(number.write_end()), std::to_string(first + getpid() % numbers)},
          {}};
}

}  // namespace

DisplayServer::DisplayServer() {
  Pipe number;
  server_.emplace(server(number));
  number.close_write_end();  // so that its end is noticed
  const std::string display = number.line(start_limit());
  if (display.empty()) throw run_error("Xvfb: no X server for pictures could be started; is it installed?");
  setenv("DISPLAY", (":" + display).c_str(), 1);
}

}  // namespace tether
