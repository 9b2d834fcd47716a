#include "common/base/child_process.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "common/base/error.hpp"

namespace tether {
namespace {

Command shell(const std::string& script) {
  return {{"/bin/sh", "-c", script}, {}};
}

TEST(Capture, KeepsOutputErrorsAndExitCode) {
  const ChildEnd end = capture(shell("echo told; echo wrong >&2; exit 3"));
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.output, "told\n");
  EXPECT_EQ(end.errors, "wrong\n");
}

TEST(Capture, KeepsMoreThanAPipeHolds) {
  EXPECT_EQ(capture(shell("head -c 300000 /dev/zero | tr '\\0' x; echo y >&2")).output, std::string(300000, 'x'));
}

TEST(Capture, TellsASignalFromAnExitCode) {
  EXPECT_EQ(capture(shell("kill -KILL $$")).exit_code, 128 + SIGKILL);
}

/// Whether all that a process started ends within seconds when it is killed, microseconds after it began to start a
/// program: they keep a pipe open.
bool all_end_if_it_is_killed_after(useconds_t delay) {
  std::array<int, 2> open{};
  EXPECT_EQ(pipe(open.data()), 0);
  const pid_t starting = fork();
  if (starting == 0) {
    capture_in_foreground(shell("exec sleep 20"));
    _exit(0);
  }
  close(open[1]);
  usleep(delay);
  kill(starting, SIGKILL);
  waitpid(starting, nullptr, 0);
  pollfd end{open[0], POLLIN, 0};
  const bool ended = poll(&end, 1, 10'000) == 1;
  close(open[0]);
  return ended;
}

TEST(Capture, LeavesNothingBehindWheneverItIsKilled) {
  for (useconds_t delay = 0; delay < 3000; delay += 10)
    ASSERT_TRUE(all_end_if_it_is_killed_after(delay)) << delay << " us after its start";
}

/// As some launchers start their programs.
TEST(Capture, TakesSignalsThatThisProcessDoesNot) {
  sigset_t waiting, before;
  sigemptyset(&waiting);
  sigaddset(&waiting, SIGTERM);
  sigprocmask(SIG_BLOCK, &waiting, &before);
  const ChildEnd end = capture(shell("kill -TERM $$; exit 3"));
  sigprocmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(end.exit_code, 128 + SIGTERM);
}

TEST(HowItEnded, KnowsWhichNumbersAreSignals) {
  EXPECT_EQ(how_it_ended(3), "ended with 3");
  EXPECT_EQ(how_it_ended(128 + SIGKILL), "was ended by signal 9 (Killed)");
  EXPECT_EQ(how_it_ended(243), "ended with 243") << "what mpirun returns where it cannot start";
}

TEST(Capture, AddsToTheEnvironment) {
  EXPECT_EQ(capture({{"/bin/sh", "-c", "echo $COLOUR"}, {{"COLOUR", "red"}}}).output, "red\n");
}

TEST(Capture, NamesAProgramThatCannotBeStarted) {
  try {
    capture({{"/no/such/program"}, {}});
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "/no/such/program cannot be started: No such file or directory");
  }
}

TEST(Capture, WaitsForAProgramThatIsStoppedAndGoesOnOrIsKilled) {
  EXPECT_EQ(capture(shell("(sleep 0.3; kill -CONT $$) & kill -STOP $$; exit 5")).exit_code, 5);
  EXPECT_EQ(capture(shell("(sleep 0.3; kill -KILL $$) & kill -STOP $$; exit 5")).exit_code, 128 + SIGKILL);
}

TEST(Capture, GivesUpAProgramThatStaysStopped) {
  setenv("TETHER_STOPPED_LIMIT", "0.5", 1);
  try {
    capture(shell("kill -STOP $$; exit 5"));
    ADD_FAILURE() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("was stopped, and still was 0.5 s later"), std::string::npos);
  }
  unsetenv("TETHER_STOPPED_LIMIT");
}

TEST(RunInForeground, ReturnsTheExitCode) {
  EXPECT_EQ(run_in_foreground(shell("exit 0")).exit_code, 0);
  EXPECT_EQ(run_in_foreground(shell("exit 2")).exit_code, 2);
  EXPECT_EQ(run_in_foreground(shell("cat")).exit_code, 0) << "there is nothing to read";
}

TEST(RunInForeground, HandsSignalsOn) {
  const ForegroundEnd end = run_in_foreground(
      shell("trap 'exit 7' TERM; sleep 0.2; kill -TERM $PPID; for i in $(seq 60); do sleep 1; done; exit 1"));
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.handed_on, SIGTERM);
  EXPECT_FALSE(end.was_killed);
}

/// As where a group of processes and each of it get the same one: what comes within a second is one.
TEST(RunInForeground, HandsOnOnceWhatComesFromSeveralSides) {
  const std::string begin = "n=0; trap 'n=$((n+1))' TERM; sleep 0.2; ";
  const auto until = [](int count) {
    return "for i in $(seq 100); do [ $n -ge " + std::to_string(count) + " ] && break; sleep 0.1; done; ";
  };
  const ForegroundEnd end = run_in_foreground(
      shell(begin + "for i in 1 2 3; do kill -TERM $PPID; sleep 0.05; done; " + until(1) + "sleep 0.3; exit $n"));
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_EQ(run_in_foreground(shell(begin + "kill -TERM $PPID; sleep 3; kill -TERM $PPID; " + until(2) + "exit $n"))
                .exit_code,
            2)
      << "who asks again is obeyed";
}

TEST(Capture, InForegroundHandsSignalsOnAndWaits) {
  const ChildEnd end = capture_in_foreground(
      shell("trap 'echo ended; exit 7' TERM; sleep 0.2; kill -TERM $PPID; for i in $(seq 60); do sleep 1; done"));
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.output, "ended\n");
  EXPECT_EQ(end.handed_on, SIGTERM);
  EXPECT_EQ(capture_in_foreground(shell("exit 3")).handed_on, 0);
}

TEST(RunInForeground, TellsASignalThatEndedItFromOneThatItTells) {
  EXPECT_FALSE(run_in_foreground(shell("exit 137")).was_killed);
  const ForegroundEnd end = run_in_foreground(shell("kill -KILL $$"));
  EXPECT_TRUE(end.was_killed);
  EXPECT_EQ(end.exit_code, 137);
  EXPECT_EQ(end.handed_on, 0);
}

/// The program asks for the signal that a terminal sends which is closed.
int hung_up() {
  const ForegroundEnd end = run_in_foreground(shell("kill -HUP $PPID; sleep 0.3; exit 5"));
  return end.handed_on != 0 ? end.handed_on : end.exit_code;
}

TEST(RunInForeground, HandsOnThatATerminalIsClosedUnlessThatIsIgnored) {
  EXPECT_EQ(hung_up(), SIGHUP);
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does
  EXPECT_EQ(hung_up(), 5);
  std::signal(SIGHUP, before);
}

}  // namespace
}  // namespace tether
