#include "diagnosis/search/corrected_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace tether {
namespace {

using Values = std::vector<Overlay::Value>;

std::string list_of(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(number_text(number));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

FoundFault found_fault(const DiagnosisReport& report, const TestedEffect& effect, const StatedErrors& now) {
  const Candidate& error = report.problem.candidates[effect.candidate];
  FoundFault found{{}, error.data.middle, now.time_shift};
  for (std::size_t k = 0; k < error.amplitudes.size(); ++k)
    found.numbers[report.problem.amplitudes[static_cast<std::size_t>(error.amplitudes[k])].name] =
        effect.amplitudes(static_cast<Eigen::Index>(k));
  return found;
}

class Corrections {
 public:
  Corrections(const DiagnosisReport& report, const ObservationsCase& observations)
      : report_(report), observations_(observations) {}

  void add(const TestedEffect& effect) {
    const Candidate& error = report_.problem.candidates[effect.candidate];
    const std::string& field = error.data.field;
    const StatedErrors now = observations_.errors_of(field);
    if (!std::isnan(error.data.frame)) {
      left_out_.try_emplace(field, now.left_out).first->second.push_back(error.data.frame);
      return;
    }
    for (const auto& [within, text] : now.correction->faults.take_off(error.name, found_fault(report_, effect, now)))
      values_.push_back({field + "." + within, text});
  }

  Values values() const {
    Values all = values_;
    for (const auto& [field, frames] : left_out_) all.push_back({field + ".left_out", list_of(frames)});
    return all;
  }

 private:
  const DiagnosisReport& report_;
  const ObservationsCase& observations_;
  Values values_;
  std::map<std::string, std::vector<double>> left_out_;
};

}  // namespace

std::vector<Overlay::Value> corrections_of(const DiagnosisReport& report, const ObservationsCase& observations) {
  Corrections corrections(report, observations);
  for (const TestedEffect& effect : report.found.effects)
    if (effect.accepted && report.problem.candidates[effect.candidate].kind == Candidate::Kind::data)
      corrections.add(effect);
  return corrections.values();
}

}  // namespace tether
