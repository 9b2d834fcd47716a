#include "twin/score.hpp"

#include <iostream>

#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "tether/verbs.hpp"

namespace tether {

int score(const CommandLine& command) {
  namespace fs = std::filesystem;
  const fs::path given = command.case_file, case_file = fs::is_directory(given) ? given / "case.yaml" : given;
  const Answer answer = unsealed(sealed_answer(fs::absolute(case_file).parent_path()));
  const fs::path results = output_of(command, CaseFile(case_file));
  const Score result = score_of(read_diagnosis(results / "diagnosis.json"), answer);
  write_json(results / "score.json", result);
  if (!command.quiet) std::cout << text_of(result);
  return exit_done;
}

}  // namespace tether
