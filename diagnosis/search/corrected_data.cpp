#include "diagnosis/search/corrected_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "observation_manager/measurements/contours.hpp"
#include "observation_manager/measurements/surfaces.hpp"

namespace tether {
namespace {

using Values = std::vector<Overlay::Value>;

const LumenDataCase& data_of(const ObservationsCase& observations, const std::string& field) {
  const std::string name = field.substr(field.rfind('.') + 1);
  for (const auto& [known, source] : observations.of<SurfacesCase>())
    if (known == name && field == "observations.surfaces." + name) return source.data;
  for (const auto& [known, source] : observations.of<SlicesCase>())
    if (known == name && field == "observations.contours." + name) return source.data;
  throw std::logic_error(field + ": no such source");
}

std::string list_of(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(number_text(number + 0.0));  // not -0
  return fmt::format("[{}]", fmt::join(texts, ", "));
}
std::string list_of(const Vec3& v) {
  return list_of(std::vector<double>{v(0), v(1), v(2)});
}

Vec3 vector_of(const std::vector<double>& numbers) {
  return numbers.size() == 3 ? Vec3(numbers.data()) : Vec3::Zero();
}

/// The error's amplitudes in space, by the names of their axes.
Vec3 along_axes(const DiagnosisReport& report, const TestedEffect& effect) {
  Vec3 all = Vec3::Zero();
  const auto& own = report.problem.candidates[effect.candidate].amplitudes;
  for (std::size_t k = 0; k < own.size(); ++k)
    all(report.problem.amplitudes[static_cast<std::size_t>(own[k])].name.back() - 'x') =
        effect.amplitudes(static_cast<Eigen::Index>(k));
  return all;
}

class Corrections {
 public:
  Corrections(const DiagnosisReport& report, const ObservationsCase& observations)
      : report_(report), observations_(observations) {}

  void add(const TestedEffect& effect) {
    const Candidate& error = report_.problem.candidates[effect.candidate];
    const std::string& field = error.data.field;
    const LumenDataCase& data = data_of(observations_, field);
    const CorrectionCase& now = data.correction;
    const double size = effect.amplitudes(0);
    if (!std::isnan(error.data.frame)) {
      auto& out = left_out_.try_emplace(field, data.left_out).first->second;
      out.push_back(error.data.frame);
    } else if (error.name == "misregistration") {
      values_.push_back(
          {field + ".correction.displacement", list_of(vector_of(now.displacement) - along_axes(report_, effect))});
    } else if (error.name == "misrotation" && vector_of(now.rotation).isZero()) {
      values_.push_back({field + ".correction.rotation", list_of(-along_axes(report_, effect))});
      values_.push_back({field + ".correction.about", list_of(error.data.middle - vector_of(now.displacement))});
    } else if (error.name == "segmentation_bias") {
      values_.push_back({field + ".correction.outward", number_text(now.outward - size)});
    } else if (error.name == "gating_shift") {
      values_.push_back({field + ".time_shift", number_text(data.time_shift + size)});
    }
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
