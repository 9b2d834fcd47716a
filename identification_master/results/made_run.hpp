#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/io/record.hpp"

namespace tether {

/// A whole run that was made for somebody, as run.json in its folder has it: what it is of, and what it took.
struct MadeRun {
  static constexpr const char* type_name = "made_run";
  std::string case_hash;
  std::int64_t steps = 0;
  std::map<std::string, double> values;
  std::optional<std::string> failure;
  std::int64_t evaluations = 0;
  double cpu_seconds = 0;
  std::map<std::string, std::string> written;

  static void fields(auto& self, auto&& field) {
    field("case_hash", self.case_hash, "of all that the case says of the model, its mesh and its time step");
    field("steps", self.steps, "that were asked for");
    field("values", self.values, "numbers of the model that differ from the case");
    field("failure", self.failure, "why it ended before its end; null: it did not");
    field("evaluations", self.evaluations, "of fluid and solid together, over all steps");
    field("cpu_seconds", self.cpu_seconds, "of all processes [s]");
    field("written", self.written, "files of results, and a hash of what each held when it ended");
  }
};

/// Whether one is of the same model and values as the other, however it ended.
inline bool is_same_run(const MadeRun& one, const MadeRun& other) {
  return one.case_hash == other.case_hash && one.steps == other.steps && one.values == other.values;
}

}  // namespace tether
