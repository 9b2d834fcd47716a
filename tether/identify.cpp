#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/programs.hpp"
#include "identification_master/results/estimate.hpp"
#include "pictures/gnuplot.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

bool is_logarithmic(const EstimatedParameter& parameter) {
  return parameter.transform.starts_with("log");
}

/// Figure 11 of the paper: each parameter over time, with its 95 % interval.
std::vector<std::string> draw(const fs::path& output, const Estimate& estimate) {
  if (!has_gnuplot()) return {};
  fs::create_directories(output / "plots");
  const auto& parameters = estimate.parameters;
  std::string script = gnuplot_head(900, 60 + 260 * static_cast<int>(parameters.size())) +
                       "set datafile separator ','\nset autoscale xfix\nset xlabel 'time [s]'\nset style fill "
                       "transparent solid 0.25 noborder\n"
                       "set key top right\nset output 'plots/estimate.png'\n";
  script += fmt::format("set multiplot layout {},1\n", parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EstimatedParameter& p = parameters[i];
    const auto column = 2 + 3 * i;
    script += fmt::format("{} logscale y\nset ylabel {} noenhanced\n", is_logarithmic(p) ? "set" : "unset",
                          gnuplot_text(fmt::format("{} [{}]", p.name, p.unit)));
    script += fmt::format(
        "plot 'estimate.csv' using 1:{1}:{2} skip 1 with filledcurves linecolor 1 title '95 %', '' using 1:{0} skip 1 "
        "with lines "
        "linewidth 2 linecolor 1 title 'estimate'\n",
        column, column + 1, column + 2);
  }
  run_gnuplot(output, "estimate.gnuplot", script + "unset multiplot\n");
  return {"estimate.png"};
}

std::string remark_on(const EstimatedParameter& p, double shrunk) {
  if (p.at_bound) return fmt::format("at its {} bound", word_of(*p.at_bound));
  return shrunk > 0.7 ? "these data hardly tell" : "";
}

std::string line_of(const EstimatedParameter& p) {
  const EstimateRange& now = p.estimate;
  const double shrunk = now.theta_deviation / p.prior.theta_deviation;
  return fmt::format("  {:<22} {:>10.4g}  ({:.3g} .. {:.3g}) {:<14} {:>6.3f} {}\n", p.name, now.value, now.lower,
                     now.upper, p.unit, shrunk, remark_on(p, shrunk));
}

/// What is consistent with what was assumed, and what is not.
std::string judgement_of(const Estimate& estimate) {
  const InnovationsTold& innovations = estimate.innovations;
  if (innovations.used_data == 0) return "  No data were used: the estimates are what was known before.\n";
  const double ratio = innovations.chi_square_per_datum, repeated = innovations.autocorrelation;
  std::string text = fmt::format(
      "  misfit {:.2f} of what the stated noise explains ({:.0f} independent data); from frame to frame {:+.2f} "
      "alike\n",
      ratio, innovations.used_data, repeated);
  if (ratio > 1.5)
    text +=
        "  The data are farther from the model than their noise: something is missing that these parameters cannot "
        "make up for; the\n"
        "  intervals are optimistic. tether diagnose looks for it.\n";
  else if (repeated > 0.5 && ratio > 0.5)
    text += "  The misfit is the same from frame to frame: the intervals are optimistic.\n";
  return text;
}

/// Instead of what is consistent and where the identified case is, if nothing was corrected.
std::string what_data_would_tell(const fs::path& output) {
  return fmt::format(
      "  Nothing was corrected (observe: never): intervals and deviations are those that the data would leave.\n"
      "In {}:\n  estimate.json      what the data would tell: Gramian, spectrum, correlations, retained information\n"
      "  estimate.csv       the same over time\n"
      "  sensitivities.csv  how each observation changes with each parameter, by region and step\n"
      "  sensitivities_of_data.csv  the same, datum by datum, in the steps with frames\n",
      output.string());
}

std::string text_of(const Estimate& estimate, const fs::path& output, const std::vector<std::string>& pictures) {
  std::string text =
      fmt::format("\n  {:<22} {:>10}  {:<38} {}\n", "parameter", "estimate", "95 % interval", "deviation after/before");
  for (const EstimatedParameter& p : estimate.parameters) text += line_of(p);
  if (!estimate.corrected) return text + what_data_would_tell(output);
  text += judgement_of(estimate);
  text += fmt::format(
      "In {}:\n  estimate.json      estimates, correlations, what the data can tell, cost\n"
      "  estimate.csv       everything over time\n  identified.yaml    the case with the estimate: tether simulate "
      "{}\n",
      output.string(), (output / "identified.yaml").string());
  for (const std::string& name : pictures) text += fmt::format("  plots/{}\n", name);
  return text;
}

}  // namespace

Made<Estimate> identify(const CommandLine& command) {
  check_case(command);
  check_identification(command);
  const CaseFile file(command.case_file);
  const fs::path output = claim_output(command, file);
  run_to_end("identification_master", "identify", command);
  const WhenInterrupted way_on("the identification has come to its end; with --resume the same command draws it");
  auto estimate = read_record<Estimate>(output / "estimate.json");
  const auto pictures = draw(output, estimate);
  std::string told = text_of(estimate, output, pictures);
  return {std::move(estimate), std::move(told)};
}

}  // namespace tether
