#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/results/verdict.hpp"
#include "twin/twin_case.hpp"

namespace tether {

/// What was hidden in data, and how they were made.
struct Answer {
  static constexpr const char* type_name = "answer";
  struct Effect {
    static constexpr const char* type_name = "hidden_effect";
    std::string name, where, unit;
    double amplitude = 0;

    static void fields(auto& self, auto&& field) {
      field("name", self.name, "of the effect that was hidden");
      field("where", self.where, "its place; empty: any");
      field("amplitude", self.amplitude, "its size");
      field("unit", self.unit, "of the amplitude");
    }
  };
  Verdict verdict = Verdict::missing;
  std::vector<Effect> effects;
  std::string truth;
  int seed = 0;
  double noise = 0, image_error = 0;

  static void fields(auto& self, auto&& field) {
    field("verdict", self.verdict, "that is right");
    field("effects", self.effects, "that were hidden");
    field("truth", self.truth, "the case file of the run");
    field("seed", self.seed, "of the noise");
    field("noise", self.noise, "standard deviation of what was added [length]");
    field("image_error", self.image_error, "standard deviation of the image [length]");
  }
};

Answer answer_of(const TwinCase& given);

/// Where a twin's folder keeps its answer.
std::filesystem::path sealed_answer(const std::filesystem::path& folder);

/// Written such that nobody reads it by accident (JSON in base 64). Throws RunError if it cannot be written.
void seal(const std::filesystem::path& file, const Answer& answer);
/// Throws InputError if the file is no sealed answer.
Answer unsealed(const std::filesystem::path& file);

}  // namespace tether
