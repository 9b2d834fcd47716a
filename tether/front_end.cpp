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

struct Verb {
  const char *name, *purpose;
  int (*act)(const CommandLine&);
  bool makes_steps = false, shares_work = false, needs_case = true, shares_runs = false;
  std::string (*reference)(const std::string& format) = case_reference;
  void (*check)(const CommandLine&) = check_case;
  std::string (*plan)(const CommandLine&) = nullptr;
};

constexpr Verb planned(Verb verb, std::string (*plan)(const CommandLine&)) {
  verb.plan = plan;
  return verb;
}

constexpr std::array verbs{
    planned({"simulate", "run a case: progress, results, plots and a summary", told<RunSummary, simulate>, true},
            plan<JobVerb::simulate>),
    planned({"compare", "compare a run with the measurements; simulates first if need be",
             told<ComparisonResult, compare>, true, false, true, false, case_reference, check_for<JobVerb::compare>},
            plan<JobVerb::compare>),
    planned({"explain", "compare, find what is missing, add it, watch the error fall: the whole path",
             told<Explanation, explain>, false, true, true, true, case_reference, check_for<JobVerb::explain>},
            plan<JobVerb::explain>),
    planned({"diagnose", "find which effect the model lacks, from the measurements", told<Diagnosis, diagnose>, false,
             true, true, true, case_reference, check_for<JobVerb::diagnose>},
            plan<JobVerb::diagnose>),
    Verb{"twin", "make data with a hidden effect from another run, and a case to try on them",
         told<fs::path, make_twin>},
    Verb{"score", "hold a diagnosis of such data against the sealed answer", told<Score, score>},
    planned({"identify", "find parameters of the model from the measurements", told<Estimate, identify>, true, true,
             true, false, case_reference, check_for<JobVerb::identify>},
            plan<JobVerb::identify>),
    Verb{"measure-noise", "measure the noise of the data, which a diagnosis wants stated: of a case, or of two files",
         told<NoiseMeasurements, measure_noise>},
    Verb{"report", "make one page of a folder of results, to look at and to mail: tether report DIR",
         told<fs::path, report>},
    Verb{"build-model", "make a lumen with named openings and centrelines of a surface, as a study file says",
         told<SurfaceSummary, build_model>, false, false, true, false, study_reference, check_study},
    Verb{"fit-outlets", "find Windkessels from pressures, a flow and its split, and the state in which they begin",
         told<FittedOutlets, fit_outlets>, false, false, true, false, outlets_reference, check_outlets},
    Verb{"track-ring", "follow the ring of an opening through the frames of a segmented lumen: a table of its motion",
         told<TrackedRing, track_ring>, false, false, true, false, ring_reference, check_ring},
    Verb{"validate", "find mistakes in a case without running it", validate},
    Verb{"mesh", "write the meshes of a case for viewing", write_meshes},
    Verb{"describe", "list every field of a case file with unit, default and meaning", describe, false, false, false},
};

Program program_of(const Verb& verb) {
  Program program;
  program.name = std::string("tether ") + verb.name;
  program.purpose = verb.purpose;
  program.needs_case = verb.needs_case;
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
  if (argc == 0 || std::string(argv[0]) == "--help") {
    std::cout << "tether conform [--dt SECONDS] [--with PROGRAM] PROGRAM [ARGUMENTS]: starts a fluid or solid program, "
                 "plays its master, and checks that it keeps the contract of docs/protocol.md; --with: and that its "
                 "interface fits that of the other code, which gets the same arguments\n";
    return argc == 0 ? exit_input_wrong : exit_done;
  }
  return guarded("tether conform", [&] {
    Command command{{sibling("tether_conform").string()}, {}};
    command.words.insert(command.words.end(), argv, argv + argc);
    return run_in_foreground(command).exit_code;
  });
}

std::string usage() {
  std::string text =
      "Fluid-structure models of vessels that agree with images.\n\nUsage: tether VERB CASE.yaml [options]\n\n";
  for (const auto& verb : verbs) text += fmt::format("  {:<13} {}\n", verb.name, verb.purpose);
  text += fmt::format("  {:<13} {}\n", "conform",
                      "check a fluid or solid program of one's own: tether conform PROGRAM [ARGUMENTS]");
  text += fmt::format("  {:<13} {}\n", "submit", "give cases to Slurm: tether submit VERB CASE.yaml|FOLDER [options]");
  text += fmt::format("  {:<13} {}\n", "status", "tell what became of such a job: tether status FOLDER");
  text += fmt::format("  {:<13} {}\n", "results", "make one table of what its cases found: tether results FOLDER");
  text += fmt::format("  {:<13} {}\n", "schema", "print the JSON schema of a file of results: tether schema [FILE]");
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
