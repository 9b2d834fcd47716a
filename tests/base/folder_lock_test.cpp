#include "common/base/folder_lock.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <functional>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

/// Another process that does something and waits, or ends, with what the call returns.
class Other {
 public:
  explicit Other(const std::function<int()>& act, bool stays = false) {
    if (pipe(said_.data()) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ != 0) {
      close(said_[1]);
      return;
    }
    const char result = static_cast<char>(act());
    if (write(said_[1], &result, 1) != 1) _exit(1);
    if (stays) pause();
    _exit(0);
  }
  ~Other() {
    end();
    close(said_[0]);
  }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;
  int result() {
    char result = -1;
    return read(said_[0], &result, 1) == 1 ? result : -1;
  }
  pid_t pid() const { return pid_; }
  void end() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  std::array<int, 2> said_{};
  pid_t pid_ = 0;
};

constexpr int held = 0, refused = 1;

int try_to_hold(const std::filesystem::path& folder) {
  try {
    hold_folder(folder);
    return held;
  } catch (const InputError&) {
    return refused;
  }
}

TEST(FolderLock, IsOneProcessOwnAsLongAsItLives) {
  const TemporaryFolder folder;
  Other first([&] { return try_to_hold(folder.path()); }, true);
  ASSERT_EQ(first.result(), held);
  const std::string refusal = message_of([&] { hold_folder(folder.path()); });
  EXPECT_NE(refusal.find("process " + std::to_string(first.pid()) + ";"), std::string::npos) << refusal;
  first.end();
  EXPECT_EQ(Other([&] { return try_to_hold(folder.path()); }).result(), held) << "a killed process holds nothing";
}

TEST(FolderLock, IsSharedWithProgramsThatTheHolderStarts) {
  const TemporaryFolder folder;
  hold_folder(folder.path());
  hold_folder(folder.path());
  const std::string name = holder_name();
  Other child([&] {
    setenv(holder_variable, name.c_str(), 1);
    return try_to_hold(folder.path());
  });
  EXPECT_EQ(child.result(), held);
}

TEST(FolderLock, IsMissedWhenItsFolderIsGoneOrAnothers) {
  const TemporaryFolder folder;
  const std::filesystem::path own = folder / "own";
  Other holder([&] {
    std::filesystem::create_directories(own);
    hold_folder(own);
    const bool is_there = message_of([&] { check_held(own); }) == "accepted";
    std::filesystem::remove_all(own);
    const bool is_gone = message_of([&] { check_held(own); }) != "accepted";
    std::filesystem::create_directories(own);
    std::ofstream(own / folder_lock_name) << "another";
    const bool is_anothers = message_of([&] { check_held(own); }) != "accepted";
    return is_there && is_gone && is_anothers ? 7 : 0;
  });
  EXPECT_EQ(holder.result(), 7);
}

/// A run whose front-end was killed is still writing.
TEST(FolderLock, LastsAsLongAsAProgramThatTheHolderStarted) {
  const TemporaryFolder folder;
  pid_t orphan = 0;
  Other parent([&] {
    const int result = try_to_hold(folder.path());
    orphan = fork();
    if (orphan == 0) {
      usleep(500'000);
      _exit(0);
    }
    return result;
  });
  ASSERT_EQ(parent.result(), held);
  parent.end();
  EXPECT_EQ(try_to_hold(folder.path()), held) << "the orphan ends within the patience";
}

}  // namespace
}  // namespace tether
