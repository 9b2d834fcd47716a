#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "tether/conform/conform.hpp"
#include "tether/conform/excitation.hpp"

namespace tether::protocol {

inline constexpr double repeat_tolerance = 1e-8;         // the same evaluation twice, or after a rejected step
inline constexpr double tangent_tolerance = 1e-3;        // against central differences
inline constexpr double mean_velocity_tolerance = 1e-6;  // as of the operators: a state is known to round-off
inline constexpr double balance_tolerance = 1e-10;       // of sums over both sides of an interface: round-off
inline constexpr double symmetry_tolerance = 1e-8;       // of the solid's product
/// Of its preconditioner: single precision (2^-24), some hundred times as much after the roundings of a factor.
inline constexpr double preconditioner_tolerance = 1e-5;

/// Thrown by a check that found something wrong, or has nothing to look at.
struct Broken : RunError {
  using RunError::RunError;
};
struct Skipped : RunError {
  using RunError::RunError;
};

template <class... Args>
void require(bool condition, fmt::format_string<Args...> format, Args&&... args) {
  if (!condition) throw Broken(fmt::format(format, std::forward<Args>(args)...));
}

inline bool all_finite(const Numbers& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The checks, each a function that returns what it measured. They run in this order and build on each other.
class Examiner {
 public:
  Examiner(Partner& partner, double dt, const std::optional<Counterpart>& counterpart)
      : partner_(partner), dt_(dt), counterpart_(counterpart) {}
  std::vector<Check> run();

 private:
  using Body = std::string (Examiner::*)();
  /// False if the partner is gone.
  bool check(const std::string& name, Body body);
  void rest();  ///< leaves a step that a failed check left open

  std::string hello();
  std::string surface();
  std::string orientation();
  std::string fit();
  std::string evaluate();
  std::string repeat();
  std::string mean_velocity();
  std::string yielding();
  std::string reject();
  std::string accept();
  std::string tangent();
  std::string velocity();
  std::string operators();
  std::string operator_derivative();
  std::string state();
  std::string parameters();
  std::string wrong_sizes();
  std::string unknown_requests();
  std::string usage();
  std::string stop();

  Numbers begin_and_evaluate(double amplitude) {
    drive_->begin();
    in_step_ = true;
    return drive_->evaluate(amplitude);
  }
  StepReport end(bool accepted) {
    in_step_ = false;
    return drive_->end(accepted);
  }
  Numbers unknowns(double phase) const;
  /// What the partner replies in a step that is taken back.
  Numbers tried_response();
  /// Throws Broken unless the partner answers Failure.
  template <class Request>
  void expect_failure(const Request& request, const std::string& what);

  Partner& partner_;
  double dt_;
  std::optional<Counterpart> counterpart_;
  std::vector<Check> checks_;
  Interface surface_;
  std::optional<Excitation> drive_;
  bool in_step_ = false;
};

template <class Request>
void Examiner::expect_failure(const Request& request, const std::string& what) {
  try {
    partner_.ask(request);
  } catch (const PartnerFailed&) {
    return;
  } catch (const InputError&) {
    return;
  }
  throw Broken(what + " was accepted");
}

}  // namespace tether::protocol
