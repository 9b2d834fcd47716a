#include "tether/front_end.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "common/base/built_from.hpp"
#include "common/base/end_request.hpp"
#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/base/process.hpp"
#include "common/protocol/programs.hpp"
#include "fluid/windkessels/outlets_case.hpp"
#include "tether/plan.hpp"
#include "tether/schemas.hpp"
#include "tether/submit.hpp"
#include "tether/verbs.hpp"
#include "vessel/ring/ring_case.hpp"
#include "vessel/study/study_case.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

int describe(const CommandLine&) {
  std::cout << case_reference("text");
  return exit_done;
}

/// All that the verb would refuse before it begins.
template <JobVerb verb>
void check_for(const CommandLine& command) {
  check_case_for(verb, command.case_file);
}

/// A verb, and what it tells.
template <class Result, VerbWith<Result> verb>
int told(const CommandLine& command) {
  print(verb(command), command);
  return exit_done;
}

constexpr Argument measured_case{
    "CASE.yaml", "the case file, with measurements",
    "or: tether measure-noise FIRST SECOND [--output DIR] [--overwrite]: two surface files, "
    "segmentations of the same moment"},
    twin_case{"CASE.yaml|DIR", "the case that tether twin wrote, or its folder"},
    results_folder{"DIR", "the folder of results of tether explain, compare, diagnose, identify or simulate"},
    study_file{"STUDY.yaml", "the study file: a surface or an image, its openings, the model's wall"},
    outlets_file{"OUTLETS.yaml", "the outlets file: a flow, the pressures that it is to make, its split"},
    ring_file{"RING.yaml", "the ring file: the frames of a lumen, and which opening is followed"};

struct Verb {
  const char *name, *purpose;
  int (*act)(const CommandLine&);
  std::optional<Argument> argument = Argument{};
  bool makes_steps = false, shares_work = false, shares_runs = false;
  std::string (*reference)(const std::string& format) = case_reference;
  void (*check)(const CommandLine&) = check_case;
  std::string (*plan)(const CommandLine&) = nullptr;
};

constexpr std::array verbs{
    Verb{.name = "simulate",
         .purpose = "run a case: progress, results, plots and a summary",
         .act = told<RunSummary, simulate>,
         .makes_steps = true,
         .plan = plan<JobVerb::simulate>},
    Verb{.name = "compare",
         .purpose = "compare a run with the measurements; simulates first if need be",
         .act = told<ComparisonResult, compare>,
         .makes_steps = true,
         .check = check_for<JobVerb::compare>,
         .plan = plan<JobVerb::compare>},
    Verb{.name = "explain",
         .purpose = "compare, find what is missing, add it, watch the error fall: the whole path",
         .act = told<Explanation, explain>,
         .shares_work = true,
         .shares_runs = true,
         .check = check_for<JobVerb::explain>,
         .plan = plan<JobVerb::explain>},
    Verb{.name = "diagnose",
         .purpose = "find which effect the model lacks, from the measurements",
         .act = told<Diagnosis, diagnose>,
         .shares_work = true,
         .shares_runs = true,
         .check = check_for<JobVerb::diagnose>,
         .plan = plan<JobVerb::diagnose>},
    Verb{.name = "twin",
         .purpose = "make data with a hidden effect from another run, and a case to try on them",
         .act = told<fs::path, make_twin>},
    Verb{.name = "score",
         .purpose = "hold a diagnosis of such data against the sealed answer",
         .act = told<Score, score>,
         .argument = twin_case},
    Verb{.name = "identify",
         .purpose = "find parameters of the model from the measurements",
         .act = told<Estimate, identify>,
         .makes_steps = true,
         .shares_work = true,
         .check = check_for<JobVerb::identify>,
         .plan = plan<JobVerb::identify>},
    Verb{.name = "measure-noise",
         .purpose = "measure the noise of the data, which a diagnosis wants stated: of a case, or of two surfaces",
         .act = told<NoiseMeasurements, measure_noise>,
         .argument = measured_case},
    Verb{.name = "report",
         .purpose = "make one page of a folder of results, to look at and to mail",
         .act = told<fs::path, report>,
         .argument = results_folder},
    Verb{.name = "build-model",
         .purpose = "make a lumen with named openings and centrelines of a surface or an image, and a model of it",
         .act = told<SurfaceSummary, build_model>,
         .argument = study_file,
         .reference = study_reference,
         .check = check_study},
    Verb{.name = "fit-outlets",
         .purpose = "find Windkessels from pressures, a flow and its split, and the state in which they begin",
         .act = told<FittedOutlets, fit_outlets>,
         .argument = outlets_file,
         .reference = outlets_reference,
         .check = check_outlets},
    Verb{.name = "track-ring",
         .purpose = "follow the ring of an opening through the frames of a segmented lumen: a table of its motion",
         .act = told<TrackedRing, track_ring>,
         .argument = ring_file,
         .reference = ring_reference,
         .check = check_ring},
    Verb{.name = "validate", .purpose = "find mistakes in a case without running it", .act = validate},
    Verb{.name = "mesh", .purpose = "write the meshes of a case for viewing", .act = write_meshes},
    Verb{.name = "describe",
         .purpose = "list every field of a case file with unit, default and meaning",
         .act = describe,
         .argument = std::nullopt},
};

Program program_of(const Verb& verb) {
  Program program;
  program.name = std::string("tether ") + verb.name;
  program.purpose = verb.purpose;
  program.argument = verb.argument;
  program.shares_work = verb.shares_work;
  program.shares_runs = verb.shares_runs;
  program.makes_steps = verb.makes_steps;
  program.reference = verb.reference;
  program.validate = verb.check;
  if (verb.plan) program.plan = verb.plan;
  program.run = verb.act;
  return program;
}

/// tether conform PROGRAM [ARGUMENTS]: whether a code of one's own keeps the contract of docs/protocol.md.
int conform(int argc, char** argv) {
  return guarded("tether conform", [&] {
    Command command{{sibling("tether_conform").string()}, {}};
    command.words.insert(command.words.end(), argv, argv + argc);
    return run_in_foreground(command).exit_code;
  });
}

std::string usage() {
  std::string text =
      "Fluid-structure models of vessels that agree with images.\n\nUsage: tether VERB ARGUMENT [options]\n\n";
  const auto add = [&](const char* verb, const char* argument, const char* purpose) {
    text += fmt::format("  {:<13} {:<22} {}\n", verb, argument, purpose);
  };
  for (const Verb& verb : verbs) add(verb.name, verb.argument ? verb.argument->name : "", verb.purpose);
  add("conform", "PROGRAM [ARGUMENTS]", "check a fluid or solid program of one's own");
  add("submit", "VERB CASE.yaml|FOLDER", "give cases to Slurm");
  add("status", "FOLDER", "tell what became of such a job");
  add("results", "FOLDER", "make one table of what its cases found");
  add("schema", "[FILE]", "print the JSON schema of a file of results");
  return text + "\ntether VERB --help lists the options of a verb.\n";
}

}  // namespace

namespace {

/// "tether 0.1.0 (a1b2c3d)": of the project, and of the commit that it was built from.
std::string version() {
  const std::string commit = built_from;
  return fmt::format("tether {}{}", TETHER_VERSION, commit.empty() ? "" : " (" + commit + ")");
}

/// As behind `| head`: whoever reads has seen enough.
bool has_no_reader(int descriptor) {
  pollfd asked{descriptor, 0, 0};
  return poll(&asked, 1, 0) == 1 && (asked.revents & POLLERR) != 0;
}

/// The exit code, if all that somebody wants to read could be written.
int told_to_the_end(int exit_code) {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  if (has_no_reader(STDOUT_FILENO)) return exit_code;
  std::cerr << "tether: what it tells cannot be written: is the disk full?" << std::endl;
  return exit_code == exit_done ? exit_run_failed : exit_code;
}

int answered(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word == "conform") return conform(argc - 2, argv + 2);
  if (word == "measure-noise" && argc > 3 && argv[2][0] != '-' && argv[3][0] != '-')
    return measure_noise_of_files(argc - 2, argv + 2);
  if (word == "schema") return print_schema(argc - 2, argv + 2);
  if (word == "submit") return submit(argc - 2, argv + 2);
  if (word == "status") return job_status(argc - 2, argv + 2);
  if (word == "results") return job_results(argc - 2, argv + 2);
  if (word == "--version") {
    std::cout << version() << '\n';
    return exit_done;
  }
  const auto verb = std::find_if(verbs.begin(), verbs.end(), [&](const auto& v) { return v.name == word; });
  if (verb != verbs.end()) return run_main(argc - 1, argv + 1, program_of(*verb));
  const bool asked = word == "--help" || word == "-h" || word == "help";
  if (!asked && !word.empty()) std::cerr << "tether: unknown verb '" << word << "'\n\n";
  (asked ? std::cout : std::cerr) << usage();
  return asked ? exit_done : exit_input_wrong;
}

}  // namespace

int front_end(int argc, char** argv) {
  prepare_process();  // before a file is opened
  end_when_interrupted();
  std::signal(SIGPIPE, SIG_IGN);  // no run ends because nobody reads any more how it goes
  const EndRequests requests;
  return told_to_the_end(answered(argc, argv));
}

}  // namespace tether
