#include "identification_master/run_service.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "common/base/error.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::ParameterInfo;

/// What is in a folder is no finished run any more; one that is shared stays.
void give_up(const fs::path& folder) {
  fs::remove(fs::is_symlink(folder) ? folder : folder / "run.json");
}

protocol::RunEnded told(const std::string& folder, const MadeRun& run, bool is_new) {
  return {folder, run.failure.value_or(""), is_new, run.evaluations, is_new ? run.cpu_seconds : 0};
}

}  // namespace

RunService::RunService(RunMakers& makers, std::string case_hash, std::int64_t steps, RunStore shared)
    : makers_(makers),
      case_hash_(std::move(case_hash)),
      steps_(steps),
      shared_(std::move(shared)),
      at_work_(makers.groups()) {}

protocol::Ready RunService::operator()(const protocol::OrderRuns& m) {
  for (const protocol::RunOrder& order : m.runs) {
    Work work{order, m.guide, run_of(order)};
    if (const auto made = stored(work.run, order.folder))
      ended_.push_back(told(order.folder, *made, false));
    else
      waiting_.push_back(std::move(work));
  }
  begin_waiting();
  return {};
}

protocol::RunEnded RunService::operator()(const protocol::NextRun&) {
  if (ended_.empty()) end_next();
  protocol::RunEnded first = std::move(ended_.front());
  ended_.pop_front();
  return first;
}

std::optional<MadeRun> RunService::stored(const MadeRun& wanted, const std::string& folder) const {
  const std::optional<MadeRun> own = made_run_in(folder);
  if (!own || !is_same_run(*own, wanted)) return shared_.lend(wanted, folder);
  if (own->failure) return failed_.contains(folder) ? own : std::nullopt;
  shared_.take(*own, folder);
  return own;
}

MadeRun RunService::run_of(const protocol::RunOrder& order) const {
  MadeRun run;
  run.case_hash = case_hash_;
  run.steps = steps_;
  const protocol::Simulate all = request(order);
  for (std::size_t i = 0; i < all.names.size(); ++i)
    if (all.values[i] != makers_.model().parameters[i].value) run.values[all.names[i]] = all.values[i];
  return run;
}

protocol::Simulate RunService::request(const protocol::RunOrder& order) const {
  protocol::Simulate all{{}, {}, steps_, order.folder, {}};
  for (const ParameterInfo& p : makers_.model().parameters) {
    all.names.push_back(p.name);
    all.values.push_back(p.value);
  }
  for (std::size_t i = 0; i < order.names.size(); ++i) {
    const auto found = std::find(all.names.begin(), all.names.end(), order.names[i]);
    if (found == all.names.end()) throw run_error("{}: the model has no number {}", order.folder, order.names[i]);
    all.values[static_cast<std::size_t>(found - all.names.begin())] = order.values.at(i);
  }
  return all;
}

void RunService::begin_waiting() {
  for (std::size_t group = 0; group < at_work_.size() && !waiting_.empty(); ++group) {
    if (at_work_[group]) continue;
    at_work_[group] = std::move(waiting_.front());
    waiting_.pop_front();
    const Work& work = *at_work_[group];
    give_up(work.order.folder);
    protocol::Simulate run = request(work.order);
    run.guide = work.guide;
    makers_.begin(group, run);
  }
}

void RunService::end_next() {
  if (std::none_of(at_work_.begin(), at_work_.end(), [](const auto& work) { return work.has_value(); }))
    throw run_error("no run is under way");
  const RunMakers::End end = makers_.next();
  Work done = *std::exchange(at_work_[end.group], std::nullopt);
  begin_waiting();
  if (!end.how.failure.empty()) done.run.failure = end.how.failure, failed_.insert(done.order.folder);
  done.run.evaluations = end.how.evaluations;
  done.run.cpu_seconds = end.cpu_seconds;
  write_made_run(done.order.folder, done.run);
  if (!done.run.failure) shared_.take(done.run, done.order.folder);
  ended_.push_back(told(done.order.folder, done.run, true));
}

}  // namespace tether
