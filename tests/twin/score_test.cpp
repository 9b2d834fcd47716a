#include "twin/score.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

const Answer spine{Verdict::missing, {{"visco_elastic", "spine", "g/(cm2 s2)", 1e6}}, "truth.yaml", 1, 0.015, 0.01};

/// A diagnosis of two effects as tether diagnose writes it.
Claim diagnosis(const std::string& verdict, bool first_accepted = true, bool second_accepted = false,
                const std::string& group = "null") {
  const TemporaryFolder folder;
  const auto word = [](bool is) { return is ? "true" : "false"; };
  const std::string text = fmt::format(
      R"text({{"verdict": "{}", "more": 1, "effects": [
        {{"name": "visco_elastic", "where": "spine", "z": 9.1, "p": 1e-9, "q": 1e-8, "retained": 0.8, "group": {},
          "amplitude": {{"value": 0.9e6, "lower": 0.8e6, "upper": 0.95e6, "unit": "g/(cm2 s2)"}}, "accepted": {}}},
        {{"name": "contact", "where": "spine", "group": {}, "amplitude": {{"value": 3}}, "accepted": {}}}],
      "held_out": {{"before": 0.4, "after": 0.1}}}})text",
      verdict, group, word(first_accepted), group, word(second_accepted));
  return read_claim(folder.file("diagnosis.json", text));
}

TEST(Score, OfTheRightEffect) {
  const Score score = score_of(diagnosis("missing"), spine);
  EXPECT_TRUE(score.verdict_right);
  ASSERT_EQ(score.found.size(), 1U);
  EXPECT_EQ(score.found[0].rank, 1);
  EXPECT_TRUE(score.found[0].accepted);
  EXPECT_NEAR(*score.found[0].amplitude_error, -0.1, 1e-12);
  EXPECT_FALSE(*score.found[0].within_interval);
  EXPECT_NEAR(*score.held_out_gain, 0.75, 1e-12);
  EXPECT_EQ(text_of(score),
            "verdict: missing: right\n"
            "visco_elastic at spine: rank 1, accepted, amplitude -10.0 %, outside its interval\n"
            "held-out distance: 75.0 % less\n");
}

TEST(Score, OfAWrongEffect) {
  const Score score = score_of(diagnosis("missing", false, true), spine);
  EXPECT_FALSE(score.verdict_right);
  EXPECT_FALSE(score.found[0].accepted);
  EXPECT_EQ(score.wrongly_accepted, std::vector<std::string>{"contact at spine"});
  EXPECT_TRUE(text_of(score).starts_with("verdict: missing: right; what was accepted is not what was hidden\n"))
      << text_of(score);
  EXPECT_FALSE(score_of(diagnosis("missing", true, true), spine).verdict_right) << "one too many";
}

TEST(Score, OfAnotherVerdict) {
  const Score score = score_of(diagnosis("nothing_missing", false), spine);
  EXPECT_FALSE(score.verdict_right);
  EXPECT_EQ(score.true_verdict, Verdict::missing);
  EXPECT_TRUE(text_of(score).starts_with("verdict: nothing_missing: wrong, the answer is missing\n"));
  const Answer nothing{Verdict::nothing_missing, {}, "", 1, 0, 0};
  EXPECT_TRUE(score_of(diagnosis("nothing_missing", false), nothing).verdict_right);
  EXPECT_FALSE(score_of(diagnosis("missing"), nothing).verdict_right);
  EXPECT_EQ(score_of(diagnosis("missing"), nothing).wrongly_accepted.size(), 1U);
}

TEST(Score, OfEffectsThatLookAlike) {
  Answer alike = spine;
  alike.verdict = Verdict::ambiguous;
  EXPECT_TRUE(score_of(diagnosis("ambiguous", false, true, R"("visco_elastic at spine")"), alike).verdict_right)
      << "its group is accepted";
  const Score other = score_of(diagnosis("ambiguous", false, true), alike);
  EXPECT_FALSE(other.verdict_right);
  EXPECT_TRUE(
      text_of(other).starts_with("verdict: ambiguous: right; what was hidden is not in a group of what was accepted\n"))
      << text_of(other);
}

TEST(Score, OfAnEffectThatIsNotListedOrInAnotherUnit) {
  Answer other = spine;
  other.effects[0].where = "opposite";
  EXPECT_EQ(score_of(diagnosis("missing"), other).found[0].rank, std::nullopt);
  other.effects[0] = {"contact", "", "", 3};
  EXPECT_EQ(score_of(diagnosis("missing"), other).found[0].rank, 2) << "anywhere";
  EXPECT_NEAR(*score_of(diagnosis("missing"), other).found[0].amplitude_error, 0, 1e-12);
  EXPECT_FALSE(score_of(diagnosis("missing"), other).found[0].within_interval.has_value());
  other.effects[0] = {"visco_elastic", "spine", "Pa/m", 1e6};
  EXPECT_FALSE(score_of(diagnosis("missing"), other).found[0].amplitude_error.has_value());
}

TEST(Score, IsWritten) {
  const Score score = score_of(diagnosis("missing"), spine);
  const TemporaryFolder folder;
  write_record(folder / "score.json", score);
  std::ifstream file(folder / "score.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_TRUE(json["verdict_right"]);
  EXPECT_EQ(json["effects"][0]["rank"], 1);
  EXPECT_NEAR(json["effects"][0]["amplitude_error"], -0.1, 1e-12);
  EXPECT_NEAR(json["held_out_gain"], 0.75, 1e-12);
}

TEST(Claim, ThatCannotBeReadIsTold) {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) {
    return message_of([&] { read_claim(folder.file("d.json", text)); });
  };
  const std::string file = (folder / "d.json").string();
  EXPECT_EQ(error_of("{"), "is no diagnosis: " + file + ": is no JSON");
  EXPECT_EQ(error_of(R"({"verdict": "missing"})"), "is no diagnosis: " + file + ": effects: is missing");
  EXPECT_EQ(
      error_of(R"({"verdict": "maybe", "effects": []})"),
      "is no diagnosis: " + file +
          ": verdict: \"maybe\": must be one of missing, nothing_missing, ambiguous, not_in_catalogue, undecided");
  EXPECT_EQ(message_of([&] { read_claim(folder / "none.json"); }),
            (folder / "none.json").string() + ": no such file; run tether diagnose first");
}

TEST(Answer, IsSealedAndOpened) {
  const TemporaryFolder folder;
  seal(folder / "answer", spine);
  std::ifstream file(folder / "answer");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text.find("spine"), std::string::npos);
  EXPECT_EQ(text.find("missing"), std::string::npos);
  for (const std::size_t more : {0U, 1U, 2U}) {  // each length of the last group of base 64
    Answer answer = spine;
    answer.truth += std::string(more, 'x');
    seal(folder / "answer", answer);
    const Answer opened = unsealed(folder / "answer");
    EXPECT_EQ(opened.verdict, Verdict::missing);
    EXPECT_EQ(opened.truth, answer.truth);
    ASSERT_EQ(opened.effects.size(), 1U);
    EXPECT_EQ(opened.effects[0].where, "spine");
    EXPECT_EQ(opened.effects[0].amplitude, 1e6);
    EXPECT_EQ(opened.image_error, 0.01);
  }
  EXPECT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(message_of([&] { unsealed(folder / "pipe"); }), (folder / "pipe").string() + ": is not a file");
  EXPECT_EQ(message_of([&] { read_claim(folder / "pipe"); }),
            "is no diagnosis: " + (folder / "pipe").string() + ": is not a file");
  EXPECT_TRUE(message_of([&] { unsealed(folder.file("b", "nonsense")); }).find("is no sealed answer") !=
              std::string::npos);
}

}  // namespace
}  // namespace tether
