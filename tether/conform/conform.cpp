#include "tether/conform/conform.hpp"

#include "tether/conform/examiner.hpp"

namespace tether::protocol {

std::vector<Check> Examiner::run() {
  const std::vector<std::pair<const char*, Body>> all{
      {"says hello", &Examiner::hello},
      {"interface is a surface", &Examiner::surface},
      {"normals point out of the fluid", &Examiner::orientation},
      {"its interface fits the other code's", &Examiner::fit},
      {"a step can be evaluated", &Examiner::evaluate},
      {"the same evaluation again gives the same", &Examiner::repeat},
      {"velocity is the mean over the step", &Examiner::mean_velocity},
      {"moves with its load", &Examiner::yielding},
      {"a rejected step leaves no trace", &Examiner::reject},
      {"an accepted step reports its observables", &Examiner::accept},
      {"tangent is the derivative of the evaluation", &Examiner::tangent},
      {"tells its velocity inside, and none outside", &Examiner::velocity},
      {"operators are symmetric", &Examiner::operators},
      {"product is the derivative of the residual", &Examiner::operator_derivative},
      {"a state set again continues bit for bit", &Examiner::state},
      {"parameters can be set, unknown ones are refused", &Examiner::parameters},
      {"arrays of a wrong size are refused", &Examiner::wrong_sizes},
      {"unknown requests are refused", &Examiner::unknown_requests},
      {"reports its cost", &Examiner::usage},
      {"stops when told", &Examiner::stop}};
  for (const auto& [name, body] : all)
    if (!check(name, body)) break;
  return checks_;
}

bool Examiner::check(const std::string& name, Body body) {
  using enum Check::Result;
  try {
    checks_.push_back({name, passed, (this->*body)()});
    return true;
  } catch (const Skipped& reason) {
    checks_.push_back({name, skipped, reason.what()});
    return true;
  } catch (const PeerDied& death) {
    checks_.push_back({name, failed, death.what()});
    return false;
  } catch (const std::exception& error) {
    checks_.push_back({name, failed, error.what()});
  }
  rest();
  return drive_.has_value();
}

void Examiner::rest() {
  if (!in_step_ || !partner_.is_idle()) return;
  try {
    end(false);
  } catch (const std::exception&) {
    // The next check that needs a step will say what is wrong.
  }
}

std::vector<Check> conform(Partner& partner, double dt, const std::optional<Counterpart>& counterpart) {
  return Examiner(partner, dt, counterpart).run();
}

std::string table_of(const std::vector<Check>& checks) {
  std::string table;
  for (const Check& check : checks) {
    const char* word = check.result == Check::Result::passed   ? "PASS"
                       : check.result == Check::Result::failed ? "FAIL"
                                                               : "skip";
    table += fmt::format("{}  {:<48}{}{}\n", word, check.name, check.detail.empty() ? "" : "  ", check.detail);
  }
  return table;
}

bool all_passed(const std::vector<Check>& checks) {
  return std::none_of(checks.begin(), checks.end(), [](const Check& c) { return c.result == Check::Result::failed; });
}

}  // namespace tether::protocol
