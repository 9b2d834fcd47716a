#include "twin/score.hpp"

#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// What is to be scored in a folder of results: the whole path, or a single diagnosis.
fs::path diagnosis_in(const fs::path& results) {
  return results / (fs::exists(results / "explain.json") ? "explain.json" : "diagnosis.json");
}

/// Of the case's default folders, the one that was written last.
fs::path last_results(const fs::path& results) {
  const fs::path explained = results.string() + "_explain";
  const fs::path one = diagnosis_in(results), other = diagnosis_in(explained);
  const bool is_newer =
      fs::exists(other) && (!fs::exists(one) || fs::last_write_time(other) > fs::last_write_time(one));
  return is_newer ? explained : results;
}

}  // namespace

Made<Score> score(const CommandLine& command) {
  const fs::path given = command.case_file, case_file = fs::is_directory(given) ? given / "case.yaml" : given;
  const Answer answer = unsealed(sealed_answer(fs::absolute(case_file).parent_path()));
  const fs::path folder = output_of(command, CaseFile(case_file)),
                 results = command.output.empty() ? last_results(folder) : folder;
  Score result = score_of(read_claim(diagnosis_in(results)), answer);
  write_record(results / "score.json", result);
  std::string told = text_of(result);
  return {std::move(result), std::move(told)};
}

}  // namespace tether
