#include "diagnosis/evidence/living_runs.hpp"

#include <chrono>
#include <iostream>
#include <map>

#include "common/base/error.hpp"
#include "common/base/progress_line.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/evidence/stored_run.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* program = "identification_master";

CommandLine of_service(CommandLine command, const fs::path& case_file, const fs::path& output) {
  command.case_file = case_file;
  command.output = output / case_file.stem();
  command.overwrite = command.quiet = true;
  command.resume = false;
  return command;
}

Command service_for(const CommandLine& command, const fs::path& socket) {
  Command run = parallel_run(program, command);
  run.environment.emplace_back(protocol::run_service_socket, socket.string());
  if (!command.runs.empty()) run.environment.emplace_back(protocol::shared_runs, fs::absolute(command.runs).string());
  return run;
}

FinishedMotion motion_of(const protocol::RunEnded& ended) {
  if (ended.failure.empty()) return StoredRun(ended.folder).motion();
  FinishedMotion failed;
  failed.failure = ended.failure;
  return failed;
}

}  // namespace

LivingRuns::LivingRuns(const CommandLine& command, const fs::path& case_file, fs::path output)
    : output_(std::move(output)),
      quiet_(command.quiet),
      command_(of_service(command, case_file, output_)),
      service_(service_for(command_, listener_.path())) {
  auto channel = listener_.accept({program}, [this] { return !service_.exit_code(); });
  if (channel == nullptr) fail();
  partner_ = std::make_unique<protocol::Partner>(std::move(channel));
  try {
    model_ = partner_->hello(infinite);
  } catch (const protocol::PeerDied&) {
    fail();
  }
}

/// The socket stays open until the service has ended: that its closing is abrupt would be what it notices first.
LivingRuns::~LivingRuns() {
  try {
    if (!partner_ || !partner_->is_idle()) return;
    partner_->finish({"no more runs are wanted"});
    service_.wait();
  } catch (const std::exception&) {  // it has ended already
  }
}

std::vector<std::string> LivingRuns::columns() const {
  std::vector<std::string> all;
  for (const protocol::ObservableInfo& info : model_.observables) all.push_back(info.name);
  return all;
}

std::vector<FinishedMotion> LivingRuns::make(const std::vector<WantedRun>& wanted) {
  const protocol::OrderRuns order = order_of(wanted);
  if (!wanted.empty()) ask(order);
  std::map<std::string, FinishedMotion> motions;
  const auto begun = std::chrono::steady_clock::now();
  for (std::size_t k = 0, made = 0; k < wanted.size(); ++k) {
    const protocol::RunEnded ended = ask(protocol::NextRun{});
    note(ended);
    if (ended.made && !quiet_) {
      const double each = seconds_since(begun) / static_cast<double>(++made);
      const auto open = static_cast<double>(wanted.size() - k - 1);
      std::cout << fmt::format("run {} of {}: {}{}\n", k + 1, wanted.size(), fs::path(ended.folder).filename().string(),
                               open > 0 ? "  left " + duration_text(each * open) : "")
                << std::flush;
    }
    motions.insert_or_assign(ended.folder, motion_of(ended));
  }
  std::vector<FinishedMotion> all;
  for (const protocol::RunOrder& run : order.runs) all.push_back(motions.at(run.folder));
  return all;
}

template <class Request>
typename Request::Reply LivingRuns::ask(const Request& request) {
  try {
    return partner_->ask(request);
  } catch (const protocol::PeerDied&) {
    fail();
  }
}

protocol::OrderRuns LivingRuns::order_of(const std::vector<WantedRun>& wanted) {
  protocol::OrderRuns order;
  for (const WantedRun& run : wanted)
    order.runs.push_back({(output_ / run.folder).string(), run.values.names, run.values.values});
  if (guide_.empty() && order.runs.size() == 1) guide_ = order.runs.front().folder;
  order.guide = guide_;
  return order;
}

void LivingRuns::note(const protocol::RunEnded& ended) {
  ++cost_.runs;
  if (ended.made) {
    ++cost_.made;
    cost_.evaluations += ended.evaluations;
    cost_.cpu_seconds += ended.cpu_seconds;
  }
  if (!ended.failure.empty() && !quiet_)
    std::cout << fmt::format("run {} failed, and is left out: {}\n", fs::path(ended.folder).filename().string(),
                             ended.failure.substr(0, ended.failure.find('\n')))
              << std::flush;
}

/// The service has said why it ended, on stderr, unless it was killed.
void LivingRuns::fail() {
  const std::string name = command_.case_file.string();
  if (report_failure({service_.wait()}, program, "diagnose", command_) == exit_input_wrong)
    throw input_error("the runs of {} are refused (see above)", name);
  throw run_error("the runs of {} failed (see above); the same command goes on from there", name);
}

}  // namespace tether
