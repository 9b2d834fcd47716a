#include <cstdio>
#include <cstdlib>

#include "common/protocol/run.hpp"
#include "tether/conform/conform.hpp"

using namespace tether;
using namespace tether::protocol;

namespace {

constexpr const char* usage =
    "usage: tether_conform [--dt SECONDS] PROGRAM [ARGUMENTS]\n"
    "Plays the master against a fluid or solid program and checks that it keeps the contract of docs/protocol.md.";

struct Options {
  double dt = 1e-3;
  Program program;
};

Options options_from(std::vector<std::string> words) {
  Options options;
  if (words.size() >= 2 && words[0] == "--dt") {
    options.dt = std::atof(words[1].c_str());
    words.erase(words.begin(), words.begin() + 2);
  }
  if (words.empty() || !(options.dt > 0)) throw InputError(usage);
  options.program = {"", words[0], {words.begin() + 1, words.end()}};
  return options;
}

void examine(Session& session, const Options& options) {
  Partner& partner = session.launch({options.program}, "conform-output").front();
  if (partner.role() != "fluid" && partner.role() != "solid")
    throw input_error("{} is a {}: only a fluid or a solid can be checked", options.program.executable, partner.role());
  partner.hello();
  const auto checks = conform(partner, options.dt);
  std::printf("%s", table_of(checks).c_str());
  std::fflush(stdout);
  if (!all_passed(checks)) throw run_error("{} does not conform", options.program.executable);
}

}  // namespace

int main(int argc, char** argv) {
  return run_master("tether_conform", [&](Session& session) {
    examine(session, options_from({argv + 1, argv + argc}));
  });
}
