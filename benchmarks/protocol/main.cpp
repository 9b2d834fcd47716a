#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "common/base/process.hpp"
#include "common/protocol/run.hpp"

/// What a message costs, and what waiting costs. Run it with or without mpirun; it spawns itself as the partner.
namespace tether::protocol {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr auto pause_time = std::chrono::seconds(2);

/// A partner that returns the points it gets, and is slow to write.
struct Echo {
  Hello hello() const {
    Hello hello;
    hello.program = "echo";
    return hello;
  }
  Ready operator()(const SetParameters&) { return {}; }
  Ready operator()(const Write&) {
    std::this_thread::sleep_for(pause_time);
    return {};
  }
  Ready operator()(const Stop&) { return {}; }
  Discrepancy operator()(const Observe& m) {
    Discrepancy reply;
    reply.distances = m.points;
    return reply;
  }
};

/// Median time of one question and answer with `numbers` doubles both ways [s].
double round_trip(Partner& partner, std::size_t numbers, int repetitions) {
  const Observe question{0, std::vector<double>(numbers, 1.0)};
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = Clock::now();
    partner.ask(question);
    times.push_back(seconds_since(start));
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[static_cast<std::size_t>(repetitions / 2)];
}

void measure(Session& session) {
  const auto start = Clock::now();
  Partner& partner =
      session.launch({{"solid_observation", std::filesystem::read_symlink("/proc/self/exe"), {"partner"}}}, "").front();
  partner.hello();
  std::printf("start of a partner until its hello      %8.3f s\n", seconds_since(start));
  std::printf("memory of a partner that does nothing   %8.1f MB\n", partner.ask(GetUsage{}).peak_memory_mb);
  for (const auto& [numbers, repetitions] : {std::pair{0, 2000}, {1500, 1000}, {130'000, 100}, {10'000'000, 5}}) {
    const double seconds = round_trip(partner, static_cast<std::size_t>(numbers), repetitions);
    std::printf("round trip, %8d numbers both ways  %8.3f ms %8.0f MB/s\n", numbers, 1e3 * seconds,
                16e-6 * numbers / seconds);
  }
  const double master_before = cpu_seconds();
  partner.ask(Write{});
  const double master_cpu = cpu_seconds() - master_before;
  const double partner_before = partner.ask(GetUsage{}).cpu_seconds;
  std::this_thread::sleep_for(pause_time);
  const double partner_cpu = partner.ask(GetUsage{}).cpu_seconds - partner_before;
  std::printf("processor time of a master that waits 2 s   %8.1f ms, of a partner %8.1f ms\n", 1e3 * master_cpu,
              1e3 * partner_cpu);
  partner.stop("measured");
}

}  // namespace
}  // namespace tether::protocol

int main(int argc, char**) {
  using namespace tether::protocol;
  if (argc > 1) return run_partner<ToObservation>("solid_observation", [](const Welcome&) { return Echo{}; });
  return run_master("protocol_benchmark", measure);
}
