#include "identification_master/identification_job.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "common/base/checked_file.hpp"
#include "common/base/end_request.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/process.hpp"
#include "common/base/progress_line.hpp"
#include "common/base/way_on.hpp"
#include "common/config/changed_case.hpp"
#include "common/config/echo.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"
#include "common/protocol/signals.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/estimate_files.hpp"
#include "identification_master/identified_case.hpp"
#include "identification_master/results/estimate.hpp"
#include "identification_master/sensitivity_tables.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

IdentificationPlan plan_of(const IdentifiedCase& given, const CommandLine& command) {
  const TimeCase& time = given.file.common().time;
  IdentificationPlan plan;
  plan.start = time.start;
  plan.dt = time.step;
  plan.steps = command.steps.value_or(time.steps());
  plan.every_step = given.identification.observe != "frames";
  plan.corrects = given.identification.observe != "never";
  plan.reject_beyond = given.identification.reject_beyond;
  plan.memory_time = given.identification.memory_time;
  plan.largest_shift = given.identification.largest_shift;
  return plan;
}

std::string news(const Identification& now, const IdentifiedParameters& parameters) {
  const EstimateRecord& last = now.last();
  std::string text = fmt::format("t {:.4g} s ", last.time);
  for (std::size_t i = 0; i < parameters.list().size(); ++i) {
    const IdentifiedParameter& p = parameters.list()[i];
    const auto k = static_cast<Eigen::Index>(i);
    const ValueEstimate value = estimate_of(p, last.mean(k), std::sqrt(last.covariance(k, k)));
    text += fmt::format(" {} {:.3g} ({:.3g} .. {:.3g})", p.name, value.median, value.lower, value.upper);
  }
  return text;
}

/// Everything that a run and its continuation must have in common.
std::uint64_t fingerprint_of(const IdentifiedCase& given, GroupPool& pool, const Observations& data) {
  const CommonCase& common = given.file.common();
  std::uint64_t hash = hash_values(pool.lumen(), data.content());
  for (const std::string& section :
       {pool.model().effective_case, echo_json("time", common.time), echo_json("image", common.image),
        echo_json("observer", common.observer), echo_json("observations", given.observations),
        echo_json("identification", given.identification)})
    hash = hash_case(section, hash);
  return hash;
}

/// What a reader of the estimate must know of the data behind it.
std::vector<std::string> notices_of(const IdentificationState& found) {
  const DataTotals& all = found.totals;
  if (all.data == 0)
    return {all.rejected > 0
                ? "all data were rejected (identification.reject_beyond): the estimate is the prior"
                : "no step met any data: the estimate is the prior; look at the times of frames and traces, at "
                  "trust_distance, and at what is held out"};
  if (all.tempered_steps == 0) return {};
  return {fmt::format(
      "{} of {} steps were tempered (identification.largest_shift): {:.3g} of {:.3g} independent data were used",
      all.tempered_steps, found.step, all.used, all.data)};
}

SensitivityTables tables_of(const IdentifiedCase& given, const fs::path& output, const Observations& data,
                            const DataPrecision& precision) {
  std::vector<std::string> names;
  for (const auto& [name, parameter] : given.identification.parameters) names.push_back(name);
  return {output, data, given.lumen(), names, precision.deviations(), given.file.units()};
}

/// One identification from the launch of the groups to its files.
class Job {
 public:
  Job(const IdentifiedCase& given, const CommandLine& command, GroupPool& pool, fs::path output)
      : given_(given),
        command_(command),
        pool_(pool),
        output_(std::move(output)),
        data_(data_of(given)),
        parameters_(given.identification, pool.model().parameters, given.file),
        precision_(data_, pool.lumen(), given.file.common().time.step,
                   {given.file.common().time.start, given.file.common().time.end}),
        plan_(plan_of(given, command)),
        filter_(plan_, parameters_, prepared(), data_, pool,
                {data_, given.lumen(), pool.lumen(), given.identification.allowed, plan_.ends()}),
        table_(output_, parameters_) {}

  void run() {
    begin();
    begun_ = Clock::now();
    groups_cpu_before_ = pool_.usage().cpu_seconds;
    master_cpu_before_ = cpu_seconds();
    ProgressLine progress(filter_.state().step, plan_.steps, command_.quiet);
    try {
      while (!filter_.is_done()) {
        check_held(output_);
        filter_.advance();
        table_.append(filter_.last());
        progress.show(filter_.state().step, news(filter_, parameters_));
        const bool ends = end_is_requested() && !filter_.is_done();
        if (ends || filter_.state().step % given_.file.common().output.checkpoint_every == 0) save();
        if (ends) throw protocol::Interrupted(told_to_end);
      }
    } catch (const protocol::Interrupted& interrupted) {
      progress.end_line();
      throw protocol::Interrupted(
          fmt::format("{} in step {}\n{}", interrupted.what(), filter_.state().step + 1, what_is_saved()));
    } catch (const RunError& error) {
      progress.end_line();
      throw run_error("{}\n{}", error.what(), what_is_saved());
    }
    save();
    if (plan_.corrects)
      make_to_go_on_with(output_, identified_file, [this](const fs::path& file) {
        write_identified_case(file, given_.file, parameters_, filter_.last().mean);
      });
    const std::vector<std::string> notices = notices_of(filter_.state());
    write_estimate(output_ / "estimate.json", parameters_, filter_, facts(notices));
    if (!command_.quiet)
      for (const std::string& notice : notices) std::cout << notice << "\n";
  }

 private:
  const DataPrecision& prepared() {
    if (!plan_.every_step) precision_.count_frames_whole();
    return precision_;
  }
  void begin() {
    fingerprint_ = fingerprint_of(given_, pool_, data_);
    if (command_.resume) {
      IdentificationCheckpoint checkpoint = read_identification_checkpoint(
          output_, fingerprint_, told_changes(output_, command_.case_file),
          [this](const IdentificationCheckpoint& found) { table_.resume(found.state.step, found.table); });
      if (!checkpoint.refused.empty())
        fmt::print(stderr, "{}: the identification goes on from the checkpoint before, step {}\n", checkpoint.refused,
                   checkpoint.state.step);
      filter_.restore(std::move(checkpoint.state));
      pool_.take_up(checkpoint.at_hand);
      if (checkpoint.at_hand.size() != pool_.size())
        fmt::print(stderr,
                   "the steps before were made on {} groups, these are on {}: results differ within the coupling's "
                   "tolerance from those of as many as before (--processes {})\n",
                   checkpoint.at_hand.size(), pool_.size(), checkpoint.at_hand.size());
      cost_before_ = checkpoint.cost;
      saved_ = filter_.state().step;
      mark_output(output_, command_.case_file);
    } else {
      remove_old_estimates(output_);  // nothing speaks against new ones any more
      mark_output(output_, command_.case_file);
      table_.start(filter_.last());
    }
    if (!plan_.corrects) begin_sensitivities();
    if (command_.quiet) return;
    for (const std::string& notice : pool_.model().notices) std::cout << notice << "\n";
    std::cout << fmt::format("{} parameters, {} particles on {} groups of processes\n", parameters_.list().size(),
                             given_.particles(), pool_.size())
              << std::flush;
    if (const int last = given_.file.common().time.steps(); plan_.steps > last)
      std::cout << fmt::format("--steps {}: beyond time.end, which {} steps reach\n", plan_.steps, last) << std::flush;
  }
  void begin_sensitivities() {
    auto tables = std::make_shared<SensitivityTables>(tables_of(given_, output_, data_, precision_));
    command_.resume ? tables->continue_from(filter_.last().time) : tables->begin();
    filter_.report_sensitivities([tables](const StepSensitivities& step) { tables->add(step); });
  }
  void save() {
    table_.flush();
    write_checkpoint(output_, fingerprint_, {filter_.state(), pool_.at_hand(), cost(), table_.checksum()});
    saved_ = filter_.state().step;
  }
  std::string what_is_saved() const {
    if (!saved_) return fmt::format("{} yet", no_state_saved);
    return fmt::format("{}{} steps is in {}", state_after, *saved_, (output_ / "checkpoint").string());
  }
  /// Of these steps, and of those before a continuation.
  IdentificationCost cost() {
    IdentificationCost all = cost_before_;
    all.wall_seconds += seconds_since(begun_);
    all.cpu_seconds += pool_.usage().cpu_seconds - groups_cpu_before_;
    all.master_cpu_seconds += cpu_seconds() - master_cpu_before_;
    all.moved_values += parameters_.moved();
    return all;
  }
  IdentificationFacts facts(const std::vector<std::string>& of_data) {
    std::vector<std::string> notices = pool_.model().notices;
    notices.insert(notices.end(), of_data.begin(), of_data.end());
    const CommonCase& common = given_.file.common();
    return {.case_name = common.name,
            .title = common.title,
            .case_file = fs::absolute(given_.file.path()).string(),
            .groups = pool_.size(),
            .cost = cost(),
            .peak_memory_mb = pool_.usage().peak_memory_mb + peak_memory_mb(),
            .notices = std::move(notices)};
  }

  const IdentifiedCase& given_;
  const CommandLine& command_;
  GroupPool& pool_;
  fs::path output_;
  Observations data_;
  IdentifiedParameters parameters_;
  DataPrecision precision_;
  IdentificationPlan plan_;
  Identification filter_;
  EstimateTable table_;
  std::uint64_t fingerprint_ = 0;
  std::optional<std::int64_t> saved_;
  Clock::time_point begun_;
  double groups_cpu_before_ = 0, master_cpu_before_ = 0;
  IdentificationCost cost_before_;
};

}  // namespace

Observations data_of(const IdentifiedCase& given) {
  Observations data = load_observations(given.observations, given.lumen(), given.file);
  const std::vector<const Measurement*> all = data.all();
  if (std::all_of(all.begin(), all.end(), [](const Measurement* source) { return source->facts().held_out; }))
    throw input_error("{}: names no measurements to learn from{}", given.file.where("observations"),
                      all.empty() ? "" : ": all of them are held out");
  check_noise(data, given.file);
  return data;
}

void identify(const IdentifiedCase& given, const CommandLine& command, GroupPool& pool, const fs::path& output,
              const InputWatch& inputs) {
  Job job(given, command, pool, output);
  inputs.check();  // groups have read their case, and the data are read
  job.run();
}

}  // namespace tether
