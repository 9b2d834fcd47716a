#include "report/run_sentences.hpp"

#include <fmt/format.h>

namespace tether {
namespace {

std::string whole(const RunSummary& run) {
  std::string text = fmt::format("{:.4g} s of blood and wall in {} steps", run.time.end - run.time.start, run.steps);
  if (const auto& p = run.pressure)
    text +=
        fmt::format(": {:.1f} to {:.1f} mmHg", p->relative_to_mmhg + p->min_mmhg, p->relative_to_mmhg + p->max_mmhg);
  return text + fmt::format(", the lumen moved by at most {:.3g} mm", run.max_displacement_mm);
}

std::string beats(const Periodicity& p) {
  const BeatChange& last = p.beats.back();
  return fmt::format("{}: beat {} differs from the one before by at most {:.2g} % in pressure and {:.2g} % in volume",
                     p.periodic_from ? fmt::format("periodic since beat {}", *p.periodic_from) : "not yet periodic",
                     last.beat, 100 * last.pressure, 100 * last.volume);
}

std::string rest(const HeldBySurroundings& held) {
  return fmt::format(
      "in the image the wall's tension carries the pressure but for {:.1f} % of its forces, which the surroundings "
      "hold; most, {:.2g} of the pressure, in region {}",
      100 * held.share, held.largest, held.region);
}

std::string pulled(const RunSummary& run, const ObserverWork& observer) {
  return fmt::format(
      "no evidence for the model: an observer (gain {:g} 1/s) pulled the wall toward the data in {} of {} steps, by at "
      "most {:.2g} mm in one",
      observer.gain, observer.corrections, run.steps, observer.largest_correction_mm);
}

}  // namespace

std::vector<std::string> sentences_of(const RunSummary& run) {
  std::vector<std::string> all{whole(run)};
  if (run.observer) all.push_back(pulled(run, *run.observer));
  if (run.periodicity && !run.periodicity->beats.empty()) all.push_back(beats(*run.periodicity));
  if (run.rest && run.rest->held) all.push_back(rest(*run.rest->held));
  all.push_back(
      fmt::format("{:.2g} evaluations and {:.3g} Krylov iterations a step, {} steps done in halves; mass balance "
                  "off by at most {:.1e} {}",
                  run.coupling_iterations.mean, run.krylov_iterations.mean, run.repeated_steps,
                  run.mass_balance_error_max, run.units.flow));
  return all;
}

}  // namespace tether
