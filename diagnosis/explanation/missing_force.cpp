#include "diagnosis/explanation/missing_force.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/csv.hpp"
#include "common/config/files_to_go_on_with.hpp"
#include "common/config/identified_parameters.hpp"
#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/explanation/force_law.hpp"
#include "diagnosis/results/diagnosis.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr int knots = 24;              ///< of a traction over a run
constexpr double of_pulse = 0.25;      ///< a traction's deviation, over the range of the blood's pressure
constexpr double turns_in_a_beat = 8;  ///< after that share of the run it may be another one

const char* pressure_column(const CsvTable& table) {
  for (const char* name : {"fluid.inlet.pressure", "fluid.outlet.pressure"})
    if (table.has(name)) return name;
  return nullptr;
}

/// Linear between the times, constant outside.
double at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return values.front();
  if (next == times.end()) return values.back();
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - share) * values[i - 1] + share * values[i];
}

/// Piecewise linear in time, as a formula: a hat at each knot.
std::string formula_of(const std::vector<double>& times, const std::vector<double>& values) {
  const double first = times.front(), width = (times.back() - first) / (knots - 1);
  std::string text;
  for (int k = 0; k < knots; ++k) {
    const double knot = first + k * width;
    text +=
        fmt::format("{}{:.6g}*max(0,1-abs(t-{:.6g})/{:.6g})", k == 0 ? "" : "+", at(times, values, knot), knot, width);
  }
  return text;
}

VectorXd derivative(const VectorXd& values, const std::vector<double>& times) {
  const Eigen::Index n = values.size();
  VectorXd slope = VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(0, i - 1), b = std::min(n - 1, i + 1);
    slope(i) = (values(b) - values(a)) / (times[static_cast<std::size_t>(b)] - times[static_cast<std::size_t>(a)]);
  }
  return slope;
}

/// Distinct moments at which a lumen was measured.
std::size_t moments_of(const Observations& data) {
  std::set<double> times;
  for (const auto& source : data.lumen)
    for (const Frame& frame : source->frames())
      if (!frame.held_out) times.insert(frame.time);
  return times.size();
}

std::string law_sentence(const ForceLaw& law) {
  if (law.terms.empty()) return ", which follows neither displacement nor velocity nor pressure";
  std::string text = fmt::format(" that follows {} ({:.0f} % of it)", law.text, 100 * law.explained);
  for (const LawTerm& term : law.terms)
    if (!term.alike.empty())
      text += fmt::format("; instead of {} these data would take {} as well", term.name, fmt::join(term.alike, " or "));
  return text;
}

std::string sentence_of(const RegionForce& traction) {
  const auto [low, high] = std::minmax_element(traction.value.begin(), traction.value.end());
  return fmt::format("{}: a traction of {:.3g} .. {:.3g} {} along the outward normal{}",
                     traction.region.empty() ? "wall" : traction.region, *low, *high, traction.unit,
                     law_sentence(traction.law));
}

std::string effect_path(const std::string& name) {
  return "solid.effects." + name;
}

void place(std::vector<Overlay::Value>& values, const std::string& name, const std::string& region) {
  set_value(values, {effect_path(name) + ".type", "expression"});
  if (!region.empty()) set_value(values, {effect_path(name) + ".region", region});
}

}  // namespace

MissingForce::MissingForce(const DiagnosedCase& given, std::vector<Overlay::Value> values, fs::path folder)
    : given_(given), values_(std::move(values)), folder_(std::move(folder)) {
  fs::create_directories(folder_);
  const std::string unit = given_.file.units().symbol(dimension::pressure);
  for (const std::string& region : given.lumen.region_names)
    tractions_.push_back({region, "force_" + region, unit, {}, {}, {}, {}, {}});
  if (tractions_.empty()) tractions_.push_back({"", "force", unit, {}, {}, {}, {}, {}});
  std::erase_if(values_, [](const Overlay::Value& v) { return v.field.starts_with("identification."); });
}

/// Of the order of what the blood's pressure changes by. [pressure]
double MissingForce::prior_deviation() const {
  const CsvTable table(folder_.parent_path() / "model_0/timeseries.csv", TableOf::tether);
  const char* column = pressure_column(table);
  if (column == nullptr) return given_.file.units().from_si(1e3, dimension::pressure);
  const std::vector<double> pressure = table.numbers(column);
  const auto [low, high] = std::minmax_element(pressure.begin(), pressure.end());
  return of_pulse * (*high - *low);
}

std::vector<Overlay::Value> MissingForce::identification() const {
  std::vector<Overlay::Value> values = values_;
  for (const IdentifiedParameter& parameter : identified_parameters(given_.file.path()))
    values.push_back({"identification.parameters." + parameter.name, ""});
  const TimeCase& time = given_.file.common().time;
  const double deviation = prior_deviation(), walk = deviation / std::sqrt((time.end - time.start) / turns_in_a_beat);
  for (const RegionForce& traction : tractions_) {
    place(values, traction.parameter, traction.region);
    const std::string number = effect_path(traction.parameter) + ".parameters.f",
                      found = "identification.parameters." + traction.parameter;
    values.push_back({effect_path(traction.parameter) + ".normal", "f"});
    values.push_back({number + ".value", "0"});
    values.push_back({number + ".absent", "0"});
    values.push_back({found + ".of", "[" + effect_path(traction.parameter) + ".f]"});
    values.push_back({found + ".transform", "linear"});
    values.push_back({found + ".mean", "0"});
    values.push_back({found + ".deviation", number_text(deviation)});
    values.push_back({found + ".walk", number_text(walk)});
  }
  return values;
}

std::vector<Overlay::Value> MissingForce::with_tractions() {
  const CsvTable table(folder_ / "walk/estimate.csv", TableOf::tether);
  std::vector<Overlay::Value> values = values_;
  for (RegionForce& traction : tractions_) {
    traction.time = table.numbers("time");
    traction.value = table.numbers(traction.parameter);
    traction.lower = table.numbers(traction.parameter + ".lower");
    traction.upper = table.numbers(traction.parameter + ".upper");
    place(values, traction.parameter, traction.region);
    values.push_back({effect_path(traction.parameter) + ".normal", formula_of(traction.time, traction.value)});
  }
  return values;
}

ForceLaw MissingForce::law_of_traction(const RegionForce& traction, const StoredRun& run) const {
  const auto n = static_cast<Eigen::Index>(traction.time.size());
  const LumenSurface& lumen = given_.lumen;
  const Points normals = nodal_normals(lumen);
  const VectorXd areas = nodal_areas(lumen);
  const auto region = std::find(lumen.region_names.begin(), lumen.region_names.end(), traction.region);
  const int number = region == lumen.region_names.end() ? -1 : static_cast<int>(region - lumen.region_names.begin());
  VectorXd weight = areas;
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    if (number >= 0 && lumen.region[static_cast<std::size_t>(i)] != number) weight(i) = 0;
  weight /= weight.sum();
  const char* column = pressure_column(*run.table);
  const std::vector<double> times = run.table->numbers("time"),
                            pressures = column ? run.table->numbers(column) : std::vector<double>(times.size(), 0.0);
  LocalMotion motion{VectorXd(n), {}, {}, VectorXd(n)};
  VectorXd force(n), deviation(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double time = std::min(traction.time[k], run.lumen->times().back());
    const Points displaced = run.lumen->at(time) - run.lumen->imaged();
    motion.displacement(i) = weight.dot(displaced.cwiseProduct(normals).colwise().sum().transpose());
    motion.pressure(i) = at(times, pressures, time);
    force(i) = traction.value[k];
    deviation(i) = (traction.upper[k] - traction.lower[k]) / (2 * two_sided_95);
  }
  motion.velocity = derivative(motion.displacement, traction.time);
  motion.acceleration = derivative(motion.velocity, traction.time);
  const double correlated =
      static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(1, moments_of(given_.data)));
  return law_of(force, deviation, motion, correlated);
}

ForceFound MissingForce::laws() const {
  const StoredRun run(folder_ / "run");
  ForceFound found;
  std::vector<Overlay::Value> values = values_;
  for (RegionForce traction : tractions_) {
    traction.law = law_of_traction(traction, run);
    found.sentences.push_back(sentence_of(traction));
    if (!traction.law.terms.empty() && traction.law.is_expression) {
      place(values, traction.parameter, traction.region);
      values.push_back({effect_path(traction.parameter) + ".normal", traction.law.text});
      found.suggested_case = suggested_file;
    }
    found.regions.push_back(std::move(traction));
  }
  const CommonCase& common = given_.file.common();
  if (found.suggested_case)
    make_to_go_on_with(folder_, suggested_file, [&](const std::filesystem::path& file) {
      write_overlay(file, {given_.file.path(), common.name + "_with_law",
                           common.titled(", with laws suggested for a missing force"), values});
    });
  return found;
}

}  // namespace tether
