#include <cstdio>

#include "common/base/number_text.hpp"
#include "common/config/case_file.hpp"
#include "common/protocol/run.hpp"
#include "tether/conform/conform.hpp"

using namespace tether;
using namespace tether::protocol;

namespace {

constexpr const char* usage =
    "tether conform [--dt SECONDS] [--ranks N] [--with PROGRAM] PROGRAM [ARGUMENTS]: starts a fluid or solid program, "
    "in N processes where it is said, plays its master, and checks that it keeps the contract of docs/protocol.md; "
    "--with: and that its interface fits that of the other code, which gets the same arguments";

struct Options {
  double dt = 1e-3;
  int ranks = 1;
  std::string with;  ///< the other code; empty: none
  Program program;
};

double step_in(const std::string& text) {
  constexpr double shortest = 1e-9, longest = 10;
  const double dt = number_in<double>(text).value_or(0);
  if (!(dt >= shortest && dt <= longest))
    throw input_error("--dt: {}: must be a number from {:g} to {:g} s", text, shortest, longest);
  return dt;
}

int ranks_in(const std::string& text) {
  constexpr int most = 1000;
  const int ranks = number_in<int>(text).value_or(0);
  if (ranks < 1 || ranks > most) throw input_error("--ranks: {}: must be a whole number from 1 to {}", text, most);
  return ranks;
}

Options options_from(std::vector<std::string> words) {
  Options options;
  const auto is_end = [&] { return !words.empty() && words[0] == "--"; };
  for (; !is_end() && words.size() >= 2 && words[0].starts_with("--"); words.erase(words.begin(), words.begin() + 2)) {
    if (words[0] == "--dt")
      options.dt = step_in(words[1]);
    else if (words[0] == "--ranks")
      options.ranks = ranks_in(words[1]);
    else if (words[0] == "--with")
      options.with = words[1];
    else
      throw InputError(usage);
  }
  if (is_end()) words.erase(words.begin());
  if (words.empty()) throw InputError(usage);
  options.program = {"", words[0], {words.begin() + 1, words.end()}, options.ranks};
  return options;
}

/// Of the case that the programs get; else cgs.
UnitSystem units_of(const Program& program) {
  for (const std::string& word : program.arguments)
    if (word.ends_with(".yaml")) return CaseFile(word).units();
  return UnitSystem::cgs();
}

void examine(Session& session, const Options& options) {
  std::vector<Program> programs{options.program};
  if (!options.with.empty()) programs.push_back({"", options.with, options.program.arguments});
  const std::span<Partner> partners = session.launch(programs, "conform-output");
  Partner& partner = partners.front();
  if (partner.role() != "fluid" && partner.role() != "solid")
    throw input_error("{} is a {}: only a fluid or a solid can be checked", options.program.executable, partner.role());
  std::optional<Counterpart> counterpart;
  if (partners.size() > 1) {
    if (partners[1].role() != (partner.role() == "fluid" ? "solid" : "fluid"))
      throw input_error("{} is a {}, as {}", options.with, partners[1].role(), options.program.executable);
    counterpart.emplace(Counterpart{partners[1], units_of(options.program)});
  }
  for (Partner& each : partners) each.hello();
  const auto checks = conform(partner, options.dt, counterpart);
  if (counterpart) counterpart->partner.stop("the check is done");
  std::printf("%s", table_of(checks).c_str());
  std::fflush(stdout);
  if (!all_passed(checks)) throw run_error("{} does not conform", options.program.executable);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const bool asked = first == "--help" || first == "-h";
  if (asked || first.empty()) {
    std::fprintf(asked ? stdout : stderr, "%s\n", usage);
    return asked ? exit_done : exit_input_wrong;
  }
  return run_master("tether_conform", [&](Session& session) {
    examine(session, options_from({argv + 1, argv + argc}));
  });
}
