#include "twin/score.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "common/config/input_files.hpp"
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

/// Throws InputError for a claim on other data: a twin that was made anew has another answer.
void check_is_of(const Claim& claim, const fs::path& case_file, const fs::path& results) {
  if (!claim.data) return;
  for (const std::string& file : data_hashes(case_file))
    if (std::find(claim.data->begin(), claim.data->end(), file) == claim.data->end())
      throw input_error("{}: is of other data than {} now has: the same command as before makes it anew",
                        results.string(), case_file.string());
}

}  // namespace

Made<Score> score(const CommandLine& command) {
  const fs::path given = command.case_file, case_file = fs::is_directory(given) ? given / "case.yaml" : given;
  const Answer answer = unsealed(sealed_answer(fs::absolute(case_file).parent_path()));
  const fs::path folder = output_of(command, CaseFile(case_file)),
                 results = command.output.empty() ? last_results(folder) : folder;
  const Claim claim = read_claim(diagnosis_in(results));
  check_is_of(claim, case_file, diagnosis_in(results));
  Score result = score_of(claim, answer);
  write_record(results / "score.json", result);
  std::string told = text_of(result);
  return {std::move(result), std::move(told)};
}

}  // namespace tether
