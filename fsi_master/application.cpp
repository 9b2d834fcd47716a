#include "fsi_master/application.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

#include "common/base/checked_file.hpp"
#include "common/base/child_process.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/process.hpp"
#include "common/config/case_file.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/changed_case.hpp"
#include "common/config/echo.hpp"
#include "common/config/followed_points.hpp"
#include "common/config/input_files.hpp"
#include "common/config/input_watch.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/run.hpp"
#include "fsi_master/coupled_codes.hpp"
#include "fsi_master/group_server.hpp"
#include "fsi_master/old_results.hpp"
#include "fsi_master/periodicity.hpp"
#include "fsi_master/plausibility.hpp"
#include "fsi_master/summary.hpp"
#include "fsi_master/untold.hpp"
#include "observation_manager/measurements/flow_observations.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::Partner;

constexpr const char* program_name = "fsi_master " TETHER_VERSION;

RunPlan plan_of(const MasterCase& master, const CommandLine& command) {
  const CommonCase& common = master.file.common();
  RunPlan plan;
  plan.units = master.file.units();
  plan.start = common.time.start;
  plan.image_pressure = common.image.pressure;
  plan.dt = common.time.step;
  plan.last_step = command.steps.value_or(common.time.steps());
  plan.write_every = common.output.write_every;
  plan.checkpoint_every = common.output.checkpoint_every;
  plan.points = common.output.points;
  plan.velocity_points = master.flow.points();
  plan.coupling = echo_json("coupling", master.coupling);
  plan.resume = command.resume;
  plan.quiet = command.quiet;
  return plan;
}

/// The case and its files as they are now.
MadeFrom made_from(const fs::path& case_file) {
  MadeFrom from{case_text(case_file), {}, false};
  for (const InputFile& input : input_files(case_file))
    from.files.push_back({input.field, input.name, fmt::format("{:016x}", input.content)});
  return from;
}

std::string own_sections(MasterCase& master) {
  Echo echo;
  CommonCase common = master.file.common();
  common.declare(echo);
  echo.group("coupling", master.coupling, {});
  echo.group("initial_state", master.initial_state, {});
  return echo.json();
}

/// What a person should know before the run: in summary.json, and printed unless quiet.
std::vector<std::string> notices_of(const CoupledCodes& codes, const RunPlan& plan) {
  const std::span<Partner> partners = codes.processes();
  std::vector<std::string> all = codes.interface_notices();
  if (const std::string sentence = unusual_image_pressure(plan.image_pressure, plan.units); !sentence.empty())
    all.push_back(sentence);
  for (Partner& partner : partners) {
    const protocol::Hello& hello = partner.hello();
    for (const std::string& notice : hello.notices) all.push_back(fmt::format("{}: {}", partner.role(), notice));
    for (const std::string& sentence : unusual_numbers(hello.parameters, plan.units)) all.push_back(sentence);
    if (!hello.has_state && partner.role() != "solid_observation")
      all.push_back(fmt::format("{} ({}) announces no state: this run cannot be resumed, nor used for identification",
                                partner.role(), hello.program));
  }
  if (plan.initial) all.push_back(plan.initial->notice);
  if (!plan.quiet)
    for (const std::string& notice : all) fmt::print("{}\n", notice);
  return all;
}

/// What the processes have cost so far, in the order of RunStatistics.
std::vector<PartnerUsage> costs(Crew& crew, std::span<Partner> partners) {
  std::vector<PartnerUsage> all{{cpu_seconds(), peak_memory_mb()}, crew.fluid.usage().get(), crew.solid.usage().get()};
  for (std::size_t code = 0; code < 2; ++code) {
    if (!partners[code].is_here()) continue;
    all[0].cpu_seconds -= all[code + 1].cpu_seconds;
    all[code + 1].peak_memory_mb = 0;  // is the master's
  }
  if (partners.size() > 2) {
    const auto usage = partners[2].ask(protocol::GetUsage{});
    all.push_back({usage.cpu_seconds, usage.peak_memory_mb});
  }
  return all;
}

/// The processes in the same order.
std::vector<RunProcess> processes_of(std::span<Partner> partners) {
  std::vector<RunProcess> all{{"fsi_master", program_name, 0}};
  for (Partner& partner : partners.first(2))
    all.push_back({partner.role(), partner.hello().program, partner.hello().unknowns});
  if (partners.size() > 2) all.push_back({"observation_manager", partners[2].hello().program, 0});
  return all;
}

/// Throws InputError if a measured velocity has no place in the blood, or the fluid does not tell its velocity.
void check_velocities(const Measurement& source, FluidPartner& fluid, const CaseFile& file) {
  const Points asked = source.velocity_points();
  if (asked.cols() == 0) return;
  const std::string where = file.where(source.facts().field());
  if (!fluid.has_velocity()) throw input_error("{}: {} does not tell its velocity", where, fluid.name());
  const Points found = fluid.velocity_at(asked).get();
  if (found.array().isNaN().all())
    throw input_error("{}: none of its {} points lies in the imaged blood", where, found.cols());
}

/// Throws InputError if the run will have no column of a measured name and unit: it could not be compared.
void check_column(const NeededColumn& needed, const std::string& field, const std::vector<Column>& columns,
                  const CaseFile& file) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  const std::string where = file.where(field + "." + needed.field);
  const auto found = std::find(names.begin(), names.end(), needed.name);
  if (found == names.end())
    throw input_error("{}: the run has no {}; it has: {}", where, needed.name, fmt::join(names, ", "));
  const std::string unit = columns[static_cast<std::size_t>(found - names.begin())].unit,
                    stated = file.units().symbol(needed.dimension);
  if (unit != stated)
    throw input_error("{}: {} is in {}, the measurement in {}: is its quantity right?", where, needed.name, unit,
                      stated);
}

void check_columns(const FlowObservations& data, const std::vector<Column>& columns, const CaseFile& file) {
  for (const Measurement* source : data.all())
    for (const NeededColumn& needed : source->columns()) check_column(needed, source->facts().field(), columns, file);
}

/// What a run and its continuation have in common: what the programs tell of their cases and what they need not, and
/// how an observer uses its data.
std::vector<std::string> cases_of(std::span<Partner> processes, const MasterCase& master) {
  std::vector<std::string> all;
  for (Partner& process : processes) all.push_back(process.hello().effective_case);
  const ObserverCase& observer = master.file.common().observer;
  if (observer.is_on()) all.push_back(echo_json("observer", observer));
  all.push_back(untold_json(master, processes));
  return all;
}

/// The same with the state that the run began with, and the points that it follows.
std::uint64_t of_run(std::uint64_t model, const CaseFile& file) {
  for (const InputFile& input : input_files(file.path()))
    if (input.field.starts_with("initial_state.")) model = hash_bytes(&input.content, sizeof input.content, model);
  return hash_case(followed_json(file.common().output), model);
}

/// What the wall's code has written of how it rests, if it does.
std::optional<RestState> rest_in(const fs::path& output) {
  if (!fs::exists(output / "rest.json")) return std::nullopt;
  return read_record<RestState>(output / "rest.json");
}

/// The wall's code writes it anew when it writes next.
void drop_damaged_rest(const fs::path& output) {
  try {
    rest_in(output);
  } catch (const InputError& error) {
    std::cerr << fmt::format("{}\nit is left out, and written anew with the wall's next output\n", error.what());
    fs::remove(output / "rest.json");
  }
}

/// Which run this is, and from which state it begins.
void identify(RunPlan& plan, const MasterCase& master, std::span<Partner> processes, const Points& interface) {
  const std::uint64_t model = fingerprint(cases_of(processes, master), plan.dt, interface);
  plan.fingerprint = of_run(model, master.file);
  if (plan.resume) plan.changes = told_changes(plan.output, master.file.path());
  plan.origin = origin_of(master.file, interface, model);
  if (master.initial_state) plan.initial = initial_state_of(*master.initial_state, master.file, plan.origin);
}

/// Takes up what is there, or takes it away.
void begin(Simulation& simulation, const RunPlan& plan, const MasterCase& master) {
  if (plan.resume) {
    simulation.begin();
    mark_output(plan.output, master.file.path());
    remove_what_was_made_of_runs(plan.output);
    drop_damaged_rest(plan.output);
  } else {
    remove_old_results(plan.output);  // nothing speaks against new ones any more
    mark_output(plan.output, master.file.path());
    simulation.begin();
  }
}

/// A direct run.
void simulate(MasterCase& master, RunPlan plan, const MadeFrom& from, const InputWatch& inputs,
              std::span<Partner> processes) {
  CoupledCodes codes(master, processes);
  inputs.check();  // all programs have read them
  identify(plan, master, processes, codes.interface().points);
  const std::vector<std::string> notices = notices_of(codes, plan);
  Crew crew = codes.crew();
  crew.usage = [&crew, processes] { return costs(crew, processes); };
  for (const Measurement* source : master.flow.all()) check_velocities(*source, codes.fluid(), master.file);
  Simulation simulation(plan, crew, master.coupling.halvings);
  check_followed(master.file, codes.interface().points);
  check_columns(master.flow, simulation.columns(), master.file);
  begin(simulation, plan, master);
  simulation.run();
  const CommonCase& common = master.file.common();
  const RunFacts facts{.case_name = common.name,
                       .title = common.title,
                       .case_file = fs::absolute(master.file.path()).string(),
                       .method = codes.coupling().name(),
                       .processes = processes_of(processes),
                       .effective_case = merged_json({own_sections(master), processes[0].hello().effective_case,
                                                      processes[1].hello().effective_case}),
                       .observer_gain = common.observer.largest_gain(),
                       .notices = notices,
                       .made_from = from,
                       .interface = codes.interface_record(),
                       .periodicity = periodicity_of(plan.output / "timeseries.csv", master.file.path(), plan.start,
                                                     plan.image_pressure, plan.units),
                       .rest = rest_in(plan.output),
                       .written = hashes_of_results(plan.output)};
  check_held(plan.output);
  write_record(plan.output / "summary.json", summary_of(simulation, facts));
}

/// The same, those of them in this process that run in one.
std::vector<protocol::Program> together(std::vector<protocol::Program> programs, const CodesHere& here) {
  for (protocol::Program& program : programs)
    if (const auto found = here.find(program.executable); found != here.end() && program.processes == 1)
      program.here = found->second;
  return programs;
}

/// The master's own life.
void run_direct(const CommandLine& command, const CodesHere& here, protocol::Session& session) {
  MasterCase master(command.case_file);
  RunPlan plan = plan_of(master, command);
  plan.output = fs::absolute(claim_output(command, master.file));
  const InputWatch inputs(command.case_file);
  const MadeFrom from = made_from(command.case_file);
  const bool observed = master.file.common().observer.is_on();
  std::vector<protocol::Program> programs = programs_of(master, observed);
  if (master.coupling.processes == "together") programs = together(std::move(programs), here);
  const std::span<Partner> partners = session.launch(programs, plan.output.string());
  for (Partner& partner : partners) partner.hello();
  simulate(master, plan, from, inputs, partners);
  for (Partner& partner : partners) partner.stop("the run is done");
}

/// Its life as a group of an identification_master.
GroupServer serve_as_group(const CommandLine& command, const CodesHere& here, const protocol::Welcome& welcome,
                           protocol::Session& session) {
  auto master = std::make_unique<MasterCase>(command.case_file);
  RunPlan plan = plan_of(*master, command);
  plan.quiet = true;
  plan.write_every = plan.checkpoint_every = std::numeric_limits<int>::max();
  const std::span<Partner> partners =
      session.launch(together(programs_of(*master, master->measures_lumen), here), welcome.output);
  for (Partner& partner : partners) partner.hello();
  return GroupServer(std::move(master), std::move(plan), partners);
}

int run(const CommandLine& command, const CodesHere& here) {
  return protocol::run_either<protocol::ToGroup>(
      "fsi_master", [&](protocol::Session& session) { run_direct(command, here, session); },
      [&](const protocol::Welcome& welcome, protocol::Session& session) {
        return serve_as_group(command, here, welcome, session);
      },
      [&] { return hash_files_read(command.case_file); });
}

/// What several checks find wrong: the lines of their messages, each once.
class Findings {
 public:
  void of(const std::function<void()>& check) {
    try {
      check();
    } catch (const InputError& error) {
      std::istringstream lines(error.what());
      for (std::string line; std::getline(lines, line);)
        if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
    }
  }
  void throw_if_any() const {
    if (!lines_.empty()) throw input_error("{}", fmt::join(lines_, "\n"));
  }

 private:
  std::vector<std::string> lines_;
};

/// Our own programs check their sections of the case; of a foreign one only the file is looked for. Throws InputError.
void validate_by(const protocol::Program& partner) {
  const std::string executable = protocol::find_executable(partner);
  if (!protocol::is_own(partner.executable)) return;
  const ChildEnd end = capture({{executable, partner.arguments.front(), "--validate", "--quiet"}, {}});
  if (end.exit_code == exit_input_wrong) throw InputError(end.errors);
  if (end.exit_code != exit_done)
    throw run_error("{} --validate {}{}{}", partner.executable, how_it_ended(end.exit_code),
                    end.errors.empty() ? "" : ": ", end.errors);
}

/// Finds what is wrong with any section of the case, and reports all of it.
void validate(const CommandLine& command) {
  CaseFile file(command.case_file);
  CouplingCase coupling;
  std::optional<InitialStateCase> initial_state;
  ObservationsCase observations;
  file.read("coupling", coupling);
  file.read("initial_state", initial_state);
  file.read("observations", observations);
  const auto program = [&](const char* role, const char* field, const std::string& executable) {
    const std::string where = file.where(std::string("coupling.programs.") + field);
    return protocol::Program{role, executable, {command.case_file.string()}, 1, where};
  };
  Findings findings;
  findings.of([&] {
    file.finish();
    load_flow_observations(observations, file);
    if (initial_state) check_initial_state(*initial_state, file);
  });
  findings.of([&] { validate_by(program("fluid", "fluid", coupling.programs.fluid)); });
  findings.of([&] { validate_by(program("solid", "solid", coupling.programs.solid)); });
  if (file.common().observer.is_on())
    findings.of([&] { validate_by(program("solid_observation", "observation", coupling.programs.observation)); });
  findings.throw_if_any();
}

}  // namespace

Program fsi_master_program(const CodesHere& here) {
  Program program;
  program.name = "fsi_master";
  program.purpose = "Simulates a vessel: launches fluid and solid and brings them to agree at every time step.";
  program.declare = [](Fields& fields) {
    CouplingCase coupling;
    fields.group("coupling", coupling, meaning_of_section("coupling"));
    std::optional<InitialStateCase> initial_state;
    fields.group("initial_state", initial_state, meaning_of_section("initial_state"));
  };
  program.validate = validate;
  program.run = [here](const CommandLine& command) { return run(command, here); };
  return program;
}

}  // namespace tether
