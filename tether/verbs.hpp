#pragma once

#include <iostream>
#include <string>

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/noise.hpp"
#include "fluid/windkessels/outlets_result.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "twin/score.hpp"
#include "vessel/ring/tracked_ring.hpp"
#include "vessel/study/surface_summary.hpp"

namespace tether {

/// What a verb made: its result, which is also in the folder, and what a person is told of it.
template <class Result>
struct Made {
  Result result;
  std::string told;
};

template <class Result>
using VerbWith = Made<Result> (*)(const CommandLine&);

/// Unless the command is to be quiet.
template <class Result>
void print(const Made<Result>& made, const CommandLine& command) {
  if (!command.quiet) std::cout << made.told << std::flush;
}

// Each verb is a function. All throw InputError, RunError, or ToldFailure of a program that they started.

/// Checks the case, runs it, draws plots and says where to look.
Made<RunSummary> simulate(const CommandLine& command);

/// Simulates the command's case, which is `file`, and prints what came of it, unless the output folder holds that run,
/// with the blood's velocity at `measured_at`.
void provide_run(const CommandLine& command, const CaseFile& file, const std::filesystem::path& output,
                 const Points& measured_at = Points(3, 0));

/// Sets a finished run of the case against its measurements: comparison.json and .csv, drawings, a summary. Simulates
/// first if there is no such run.
Made<ComparisonResult> compare(const CommandLine& command);

/// Makes data from a run that has what the case lacks, and a case that is to be compared with them (docs/twin.md),
/// which is the result. Simulates that run first if need be.
Made<std::filesystem::path> make_twin(const CommandLine& command);
/// Throws InputError if the case has a section `twin` that is wrong.
void check_twin(const CommandLine& command);
/// The section `twin` for the reference of the case file.
std::string describe_twin(const std::string& format);

/// Holds the diagnosis of a twin's case, or of that in a twin's folder, against the sealed answer: score.json.
Made<Score> score(const CommandLine& command);

/// Tests every effect of the catalogue against what the measurements say of the case, and confirms the strongest with
/// runs: diagnosis.json, a suggested case, a plot, a verdict (docs/diagnosis.md).
Made<Diagnosis> diagnose(const CommandLine& command);

/// Finds the parameters that the case names from its measurements: estimate.json and .csv, a plot, the identified case.
Made<Estimate> identify(const CommandLine& command);

/// Measures the noise of the case's surfaces and contours: from repeated segmentations, from frames at rest, from what
/// the run leaves: noise.json, plots (docs/noise.md). Simulates first if there is no such run.
Made<NoiseMeasurements> measure_noise(const CommandLine& command);
/// From two surface files of the same moment, in the files' unit of length. Throws InputError if the folder holds
/// anything but what was measured of the same two, unless `overwrite`.
Made<NoiseMeasurements> measure_noise(const std::filesystem::path& first, const std::filesystem::path& second,
                                      const std::filesystem::path& output, bool overwrite);
/// tether measure-noise FIRST SECOND [--output DIR] [--overwrite]
int measure_noise_of_files(int argc, char** argv);

/// Writes report.html, a page to look at and to mail, into the folder of results that the command names
/// (docs/report.md); its path is the result.
Made<std::filesystem::path> report(const CommandLine& command);

/// From a surface to a lumen with named openings and centrelines, as a study file says (docs/build-model.md):
/// surface.vtp, centreline.vtp, surface.json, a picture of each step.
Made<SurfaceSummary> build_model(const CommandLine& command);
/// Throws InputError if the study file is wrong.
void check_study(const CommandLine& command);

/// Windkessels that make a mean and a pulse pressure, or a pressure curve, of a flow that they share
/// (docs/build-model.md): outlets.json and .csv, a plot, a case with them.
Made<FittedOutlets> fit_outlets(const CommandLine& command);
/// Throws InputError if its file is wrong.
void check_outlets(const CommandLine& command);

/// The ring of an opening through the frames of a segmented lumen (docs/heart-motion.md): ring.json, poses.csv, a plot.
Made<TrackedRing> track_ring(const CommandLine& command);
/// Throws InputError if its file is wrong.
void check_ring(const CommandLine& command);

/// Walks the whole path by itself: compares, finds what the model lacks, adds it, identifies it, compares on held-out
/// data, and again until there is a verdict: explain.json (docs/explain.md). What was done before is kept.
Made<Explanation> explain(const CommandLine& command);

/// Checks the case with every program that reads it. Throws InputError with all that they find.
void check_case(const CommandLine& command);

/// Checks the measurements, if the case names any. Throws InputError.
void check_observations(const CommandLine& command);

/// Checks what only an identification reads: its section, and the noise of the data. Throws InputError.
void check_identification(const CommandLine& command);
/// Checks all that a case says, for every verb.
int validate(const CommandLine& command);

/// Writes OUTPUT/mesh/fluid.vtu, wall.vtu and their faces, and tells sizes and quality.
int write_meshes(const CommandLine& command);

/// The reference of the whole case file, gathered from the programs that read it. `format`: text or markdown.
std::string case_reference(const std::string& format);

}  // namespace tether
