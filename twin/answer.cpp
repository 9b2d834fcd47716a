#include "twin/answer.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// RFC 4648, a line.
std::string in_base_64(const std::string& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string from_base_64(const std::string& text) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char letter : text) {
    const std::size_t value = letters.find(letter);
    if (value == std::string_view::npos) break;
    group = group << 6 | static_cast<std::uint32_t>(value);
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255U);
  }
  return bytes;
}

}  // namespace

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
  Json effects = Json::array();
  for (const auto& [name, where, unit, amplitude] : answer.effects)
    effects.push_back({{"name", name}, {"where", where}, {"unit", unit}, {"amplitude", amplitude}});
  const Json json{{"verdict", answer.verdict}, {"effects", effects},    {"truth", answer.truth},
                  {"seed", answer.seed},       {"noise", answer.noise}, {"image_error", answer.image_error}};
  std::ofstream to(file);
  to << in_base_64(json.dump()) << "\n";
  to.close();
  if (!to) throw run_error("{} cannot be written", file.string());
}

Answer unsealed(const std::filesystem::path& file) {
  std::ifstream from(file);
  if (!from) throw input_error("{}: no such file: not the folder of a twin", file.string());
  const std::string text{std::istreambuf_iterator<char>(from), {}};
  try {
    const Json json = Json::parse(from_base_64(text));
    Answer answer{json.at("verdict"), {}, json.at("truth"), json.at("seed"), json.at("noise"), json.at("image_error")};
    for (const Json& e : json.at("effects"))
      answer.effects.push_back({e.at("name"), e.at("where"), e.at("unit"), e.at("amplitude")});
    return answer;
  } catch (const Json::exception& error) {
    throw input_error("{}: is no sealed answer: {}", file.string(), error.what());
  }
}

}  // namespace tether
