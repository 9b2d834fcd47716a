#include "identification_master/diagnosis_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/base/progress_line.hpp"
#include "common/config/case_essence.hpp"
#include "common/config/echo.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using protocol::ParameterInfo;

bool is_excluded(const std::string& name, const DiagnosisCase& diagnosis) {
  return std::find(diagnosis.exclude.begin(), diagnosis.exclude.end(), name) != diagnosis.exclude.end();
}

bool within(double value, const ParameterInfo& p) {
  return value >= p.lower && value <= p.upper;
}

/// The value a step away: of what is absent by its scale, of the others by their prior. Toward the other side if this
/// one is not admissible; nothing if neither is, or if the model does not say how far is far.
std::optional<double> stepped(const ParameterInfo& p, double step) {
  const bool is_absent = p.value == p.absent, is_log = p.transform.starts_with("log");
  for (const double side : {step, -step}) {
    double value = p.value + side * (is_absent ? p.scale : p.prior_deviation);
    if (!is_absent && is_log)
      value = p.value * std::pow(p.transform == "log2" ? 2 : std::exp(1), side * p.prior_deviation);
    if (std::isfinite(value) && value != p.value && within(value, p)) return value;
  }
  return std::nullopt;
}

std::string effect_of(const ParameterInfo& p) {
  return p.name.substr(0, p.name.rfind('.'));
}

/// A gap, an angle: it shapes an effect that is switched off, and so does nothing.
bool is_idle(const ParameterInfo& p, const std::vector<ParameterInfo>& parameters) {
  if (p.absent == p.absent) return false;
  bool any = false;
  for (const ParameterInfo& other : parameters) {
    if (effect_of(other) != effect_of(p) || other.absent != other.absent) continue;
    if (other.value != other.absent) return false;
    any = true;
  }
  return any;
}

NamedValues values_of(const std::vector<ParameterInfo>& parameters) {
  NamedValues all;
  for (const ParameterInfo& p : parameters) {
    all.names.push_back(p.name);
    all.values.push_back(p.value);
  }
  return all;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json described(const ParameterInfo& p) {
  return {{"name", p.name},           {"meaning", p.meaning},     {"unit", p.unit},
          {"transform", p.transform}, {"value", p.value},         {"absent", number(p.absent)},
          {"lower", number(p.lower)}, {"upper", number(p.upper)}, {"prior_deviation", number(p.prior_deviation)},
          {"scale", number(p.scale)}};
}

/// What a run is of: enough to know it again.
std::string mark_of(const DiagnosisRun& run, const std::vector<ParameterInfo>& parameters, std::uint64_t case_hash,
                    std::int64_t steps) {
  Json values = Json::object();
  for (const ParameterInfo& p : parameters)
    for (std::size_t i = 0; i < run.values.names.size(); ++i)
      if (run.values.names[i] == p.name && run.values.values[i] != p.value) values[p.name] = run.values.values[i];
  return Json{{"case", case_hash}, {"steps", steps}, {"values", values}}.dump();
}

bool is_there(const fs::path& folder, const std::string& mark) {
  std::ifstream file(folder / "run.json");
  std::string line;
  return std::getline(file, line) && line == mark;
}

/// Why a run ended before its end; empty if it did not.
std::string failure_of(const fs::path& folder) {
  std::ifstream file(folder / "failure.txt");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::uint64_t hash_of(const protocol::Hello& model, const CaseFile& file) {
  const std::uint64_t time = hash_case(echo_json("time", file.common().time), hash_case(model.effective_case, 0));
  return hash_case(echo_json("image", file.common().image), time);
}

/// Without the base there is nothing to compare with; what fails otherwise is left out.
void tell_failure(const DiagnosisRun& run, const std::string& failure, bool quiet) {
  if (run.folder == "base") throw run_error("the model as it is: {}", failure);
  if (!quiet)
    std::cout << fmt::format("run {} failed, and is left out: {}\n", run.folder, failure.substr(0, failure.find('\n')))
              << std::flush;
}

/// Words with a dot are numbers of the model; types and parts are the front-end's.
void check_announced(const std::vector<ParameterInfo>& parameters, const DiagnosisCase& diagnosis,
                     const CaseFile& file) {
  std::vector<std::string> known;
  for (const ParameterInfo& p : parameters) known.push_back(p.name);
  const auto check = [&](const char* field, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      if (word.find('.') == std::string::npos || std::find(known.begin(), known.end(), word) != known.end()) continue;
      const std::string near = nearest(word, known);
      throw input_error(
          "{}: the model has no number {}{}", file.where(field), word,
          near.empty() ? "; runs.json of any diagnosis lists them" : fmt::format("; did you mean {}?", near));
    }
  };
  check("diagnosis.exclude", diagnosis.exclude);
  check("diagnosis.assumed", diagnosis.assumed);
  check("diagnosis.refused", diagnosis.refused);
}

}  // namespace

std::vector<DiagnosisRun> sensitivity_runs(const std::vector<ParameterInfo>& parameters, const DiagnosisCase& diagnosis,
                                           const CaseFile& file) {
  check_announced(parameters, diagnosis, file);
  std::vector<ParameterInfo> varied;
  for (const ParameterInfo& p : parameters)
    if (stepped(p, diagnosis.step) && !is_excluded(p.name, diagnosis) && !is_idle(p, parameters)) varied.push_back(p);
  const NamedValues base = values_of(varied);
  std::vector<DiagnosisRun> runs{{"base", {}, base}};
  for (std::size_t i = 0; i < varied.size(); ++i) {
    runs.push_back({varied[i].name, varied[i].name, base});
    runs.back().values.values[i] = *stepped(varied[i], diagnosis.step);
  }
  return runs;
}

std::vector<DiagnosisRun> trial_runs(const std::vector<ParameterInfo>& parameters, const DiagnosisCase& diagnosis,
                                     const CaseFile& file) {
  std::vector<DiagnosisRun> runs;
  for (const auto& [name, trial] : diagnosis.trials) {
    const std::string field = "diagnosis.trials." + name;
    if (trial.parameters.size() != trial.values.size())
      throw input_error("{}: {} numbers, but {} values", file.where(field), trial.parameters.size(),
                        trial.values.size());
    runs.push_back({name, {}, values_of(parameters)});
    NamedValues& values = runs.back().values;
    for (std::size_t i = 0; i < trial.values.size(); ++i) {
      const auto found = std::find(values.names.begin(), values.names.end(), trial.parameters[i]);
      if (found == values.names.end())
        throw input_error("{}: the model has no number {}", file.where(field), trial.parameters[i]);
      values.values[static_cast<std::size_t>(found - values.names.begin())] = trial.values[i];
    }
  }
  return runs;
}

void make_runs(GroupPool& pool, const std::vector<DiagnosisRun>& runs, const CaseFile& file, const fs::path& output,
               std::int64_t steps, bool quiet) {
  const auto begun = std::chrono::steady_clock::now();
  const double cpu_before = pool.usage().cpu_seconds;
  const std::uint64_t hash = hash_of(pool.model(), file);
  std::vector<const DiagnosisRun*> missing;
  for (const DiagnosisRun& run : runs)
    if (!is_there(output / "runs" / run.folder, mark_of(run, pool.model().parameters, hash, steps)))
      missing.push_back(&run);
  for (std::size_t first = 0; first < missing.size(); first += pool.size()) {
    std::vector<NamedValues> values;
    std::vector<std::string> folders;
    const std::size_t last = std::min(first + pool.size(), missing.size());
    for (std::size_t i = first; i < last; ++i) {
      values.push_back(missing[i]->values);
      folders.push_back((output / "runs" / missing[i]->folder).string());
      fs::remove(fs::path(folders.back()) / "run.json");
    }
    pool.simulate(values, folders, steps);
    for (std::size_t i = first; i < last; ++i)
      std::ofstream(fs::path(folders[i - first]) / "run.json")
          << mark_of(*missing[i], pool.model().parameters, hash, steps) << "\n";
    if (!quiet)
      std::cout << fmt::format("run {} of {}: {}\n", last, missing.size(), missing[last - 1]->folder) << std::flush;
    for (std::size_t i = first; i < last; ++i)
      if (const std::string failure = failure_of(folders[i - first]); !failure.empty())
        tell_failure(*missing[i], failure, quiet);
  }
  Json json{{"steps", steps}, {"groups", pool.size()}, {"made", missing.size()}};
  json["cpu_seconds"] = pool.usage().cpu_seconds - cpu_before;
  json["wall_seconds"] = seconds_since(begun);
  json["parameters"] = Json::array();
  for (const ParameterInfo& p : pool.model().parameters) json["parameters"].push_back(described(p));
  json["runs"] = Json::array();
  for (const DiagnosisRun& run : runs) {
    Json one{{"folder", run.folder}, {"parameter", run.parameter.empty() ? Json() : Json(run.parameter)}};
    for (std::size_t i = 0; i < run.values.names.size(); ++i)
      if (run.values.names[i] == run.parameter) one["value"] = run.values.values[i];
    if (const std::string failure = failure_of(output / "runs" / run.folder); !failure.empty())
      one["failure"] = failure;
    json["runs"].push_back(one);
  }
  std::ofstream to(output / "runs.json");
  to << json.dump(1) << "\n";
  to.close();
  if (!to) throw run_error("{} cannot be written", (output / "runs.json").string());
}

}  // namespace tether
