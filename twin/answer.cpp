#include "twin/answer.hpp"

#include <fstream>

#include "common/base/base64.hpp"
#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/write_error.hpp"
#include "common/io/record_file.hpp"

namespace tether {

Answer answer_of(const TwinCase& given) {
  Answer answer;
  answer.verdict = given.hidden.verdict;
  answer.truth = given.truth.string();
  answer.seed = given.seed;
  answer.noise = given.noise.deviation;
  for (const auto& [name, effect] : given.hidden.effects)
    answer.effects.push_back(
        {effect.effect.empty() ? name : effect.effect, effect.where, effect.unit, effect.amplitude});
  return answer;
}

std::filesystem::path sealed_answer(const std::filesystem::path& folder) {
  return folder / "sealed" / "answer";
}

void seal(const std::filesystem::path& file, const Answer& answer) {
  std::ofstream to(file);
  const std::string text = json_of(answer);
  to << base64(text.data(), text.size()) << "\n";
  to.close();
  if (!to) throw write_error(file);
}

Answer unsealed(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw input_error("{}: no such file: not the folder of a twin", file.string());
  const std::string text = content_of(file, 1'000'000);
  try {
    return record_of<Answer>(from_base64(text), file.string());
  } catch (const InputError& error) {
    throw input_error("{}: is no sealed answer: {}", file.string(), error.what());
  }
}

}  // namespace tether
