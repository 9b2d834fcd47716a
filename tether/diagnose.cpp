#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/case/mesh_case.hpp"
#include "common/config/output_folder.hpp"
#include "common/config/overlay.hpp"
#include "common/io/lumen_motion.hpp"
#include "diagnosis/data_errors.hpp"
#include "tether/diagnosis_text.hpp"
#include "tether/programs.hpp"
#include "tether/suggested_case.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A case with measurements whose noise is stated.
struct DiagnosedCase {
  explicit DiagnosedCase(const fs::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("observations", observations);
    file.read("diagnosis", diagnosis);
    file.finish();
    lumen = lumen_of(load_mesh(mesh, file.units(), WallElement::prism));
    data = load_observations(observations, lumen, file);
    if (data.lumen.empty() && data.traces.empty())
      throw input_error("{}: names nothing that was measured", file.where("observations"));
    for (const auto& source : data.lumen) check(source->settings().noise, true, source->settings().name);
    for (const Trace& trace : data.traces) check(trace.noise, false, trace.name);
  }
  void check(const Noise& noise, bool on_lumen, const std::string& name) const {
    if (noise.deviation > 0 && (!on_lumen || noise.correlation_length > 0)) return;
    throw input_error(
        "{}: {}: noise.deviation{} must be given: how far data err, and how far errors are alike, decides what they "
        "can tell",
        file.where("observations"), name, on_lumen ? " and noise.correlation_length" : "");
  }
  CaseFile file;
  MeshCase mesh;
  ObservationsCase observations;
  DiagnosisCase diagnosis;
  LumenSurface lumen;
  Observations data;
};

/// A run's folder, read when it is needed.
struct StoredRun {
  explicit StoredRun(const fs::path& folder)
      : lumen(std::make_shared<LumenMotion>(folder / "lumen.motion")),
        table(std::make_shared<CsvTable>(folder / "timeseries.csv")) {}
  FinishedMotion motion() const {
    return {{lumen->times().front(), lumen->times().back(), lumen->imaged(),
             [kept = lumen](double time) { return kept->at(time); }},
            [kept = table](const std::string& column) {
              return RunTrace{kept->numbers("time"), kept->numbers(column), kept->unit(column)};
            }};
  }
  std::shared_ptr<LumenMotion> lumen;
  std::shared_ptr<CsvTable> table;
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The runs of a diagnosis: those that identification_master makes of a case that is written for it.
class Runs {
 public:
  Runs(const CommandLine& command, fs::path output) : command_(command), output_(std::move(output)) {}

  /// Makes the runs that CASE asks for, in a folder of its name. Returns runs.json.
  Json make(const fs::path& case_file) {
    CommandLine command = command_;
    command.case_file = case_file;
    command.output = folder_of(case_file);
    command.overwrite = true;
    command.resume = false;
    if (const int code = run_in_foreground(parallel_run("identification_master", command)); code != exit_done)
      throw run_error("the runs of {} failed (see above)", case_file.string());
    Json json = Json::parse(content_of(command.output / "runs.json"));
    all += static_cast<int>(json["runs"].size());
    made += json["made"].get<int>();
    cpu_seconds += json["cpu_seconds"].get<double>();
    return json;
  }
  fs::path folder_of(const fs::path& case_file) const { return output_ / case_file.stem(); }

  int all = 0, made = 0;
  double cpu_seconds = 0;

 private:
  const CommandLine& command_;
  fs::path output_;
};

/// From the case to the report.
class Job {
 public:
  Job(const DiagnosedCase& given, const CommandLine& command, fs::path output)
      : given_(given),
        output_(std::move(output)),
        runs_(command, output_),
        effects_(catalogue_of(command.case_file, given.diagnosis)) {}

  DiagnosisReport run() {
    const fs::path candidates = output_ / "candidates.yaml";
    write_candidates(candidates, given_.file, effects_);
    const Json runs = runs_.make(candidates);
    DiagnosisReport report;
    report.case_name = given_.file.common().name;
    report.title = given_.file.common().title;
    report.alpha = given_.diagnosis.alpha;
    std::vector<FinishedMotion> motions;
    for (const Json& run : runs["runs"])
      motions.push_back(StoredRun(runs_.folder_of(candidates) / "runs" / run["folder"].get<std::string>()).motion());
    const Evidence evidence(given_.data, given_.lumen, motions.front());
    report.problem = problem_of(evidence, motions, runs.dump());
    const DiagnosisCase& d = given_.diagnosis;
    report.found =
        search_effects(report.problem, {d.alpha, d.unexplained, d.most, d.refinements, d.confirmed},
                       [&](const MatrixXd& amplitudes) { return residual_at(report.problem, evidence, amplitudes); });
    if (write_suggested(output_ / "suggested.yaml", given_.file, report, effects_)) report.suggested = "suggested.yaml";
    report.runs = runs_.all;
    report.runs_made = runs_.made;
    report.cpu_seconds = runs_.cpu_seconds;
    return report;
  }

 private:
  EffectProblem problem_of(const Evidence& evidence, const std::vector<FinishedMotion>& motions,
                           const std::string& runs) const {
    const UnitSystem& units = given_.file.units();
    std::vector<const FinishedMotion*> all;
    for (const FinishedMotion& motion : motions) all.push_back(&motion);
    EffectProblem problem = evidence.problem();
    add_model_changes(problem, runs, evidence.residuals(all), effects_, given_.diagnosis);
    const AllowanceCase& allowed = given_.diagnosis.allowed;
    add_data_errors(problem, evidence, motions.front(), allowed, units.symbol(dimension::length),
                    units.symbol(dimension::time));
    add_patterns(problem, evidence, allowed, motions.front().motion.start, motions.front().motion.end);
    return problem;
  }

  /// Runs of the model with these amplitudes; errors of the data are added to first order, which is exact for most.
  MatrixXd residual_at(const EffectProblem& problem, const Evidence& evidence, const MatrixXd& amplitudes) {
    const fs::path trials = output_ / "trials.yaml";
    write_trials(trials, problem, amplitudes);
    const Json runs = runs_.make(trials);
    std::vector<FinishedMotion> motions;
    for (const Json& run : runs["runs"])
      motions.push_back(StoredRun(runs_.folder_of(trials) / "runs" / run["folder"].get<std::string>()).motion());
    std::vector<const FinishedMotion*> all;
    for (const FinishedMotion& motion : motions) all.push_back(&motion);
    MatrixXd residuals = evidence.residuals(all);
    residuals = residuals.array().isFinite().select(residuals, problem.residual.replicate(1, residuals.cols()));
    for (const Candidate& candidate : problem.candidates)
      if (candidate.kind == Candidate::Kind::data)
        for (const Eigen::Index i : candidate.amplitudes) residuals -= problem.changes.col(i) * amplitudes.row(i);
    return residuals;
  }

  void write_trials(const fs::path& file, const EffectProblem& problem, const MatrixXd& amplitudes) {
    Overlay overlay{
        output_ / "candidates.yaml", given_.file.common().name + "_trials", {}, {{"diagnosis.runs", "trials"}}};
    for (Eigen::Index k = 0; k < amplitudes.cols(); ++k) {
      std::string names, values;
      for (const Candidate& candidate : problem.candidates)
        for (const Eigen::Index i : candidate.amplitudes) {
          if (candidate.kind == Candidate::Kind::data || amplitudes(i, k) == 0) continue;
          const Amplitude& amplitude = problem.amplitudes[static_cast<std::size_t>(i)];
          names += (names.empty() ? "" : ", ") + amplitude.name;
          values += (values.empty() ? "" : ", ") + number_text(amplitude.value(amplitudes(i, k)));
        }
      const std::string trial = fmt::format("diagnosis.trials.trial_{:03}", ++trials_);
      overlay.values.push_back({trial + ".parameters", "[" + names + "]"});
      overlay.values.push_back({trial + ".values", "[" + values + "]"});
    }
    write_overlay(file, overlay);
  }

  const DiagnosedCase& given_;
  fs::path output_;
  Runs runs_;
  std::vector<PlacedEffect> effects_;
  int trials_ = 0;
};

std::string where_to_look(const fs::path& output, const DiagnosisReport& report,
                          const std::vector<std::string>& pictures) {
  std::string text = fmt::format(
      "{} runs, {} of them made now, {:.0f} s of CPU\nIn {}:\n  diagnosis.json     every candidate, what these data "
      "would show, cost\n",
      report.runs, report.runs_made, report.cpu_seconds, output.string());
  if (!report.suggested.empty())
    text += fmt::format("  suggested.yaml     the case with the effect: tether identify {}\n",
                        (output / report.suggested).string());
  for (const std::string& name : pictures) text += fmt::format("  plots/{}\n", name);
  return text;
}

}  // namespace

int diagnose(const CommandLine& command) {
  check_case(command);
  const DiagnosedCase given(command.case_file);
  const fs::path output = fs::absolute(claim_output(command, given.file));
  const DiagnosisReport report = Job(given, command, output).run();
  write_json(output / "diagnosis.json", report);
  const auto pictures = draw_ranking(report, output);
  if (!command.quiet) std::cout << text_of(report) << where_to_look(output, report, pictures);
  return exit_done;
}

}  // namespace tether
