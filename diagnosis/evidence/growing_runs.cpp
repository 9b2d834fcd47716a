#include "diagnosis/evidence/growing_runs.hpp"

namespace tether {
namespace {

RunsCost sum(const RunsCost& a, const RunsCost& b) {
  return {a.runs + b.runs, a.made + b.made, a.evaluations + b.evaluations, a.cpu_seconds + b.cpu_seconds};
}

}  // namespace

GrowingRuns::GrowingRuns(std::vector<PlacedEffect> effects, Make make)
    : effects_(std::move(effects)), make_(std::move(make)) {}

void GrowingRuns::add(const std::vector<PlacedEffect>& more) {
  rest();
  ++grown_;
  effects_.insert(effects_.end(), more.begin(), more.end());
}

void GrowingRuns::rest() {
  before_ = cost();
  now_.reset();
}

RunsCost GrowingRuns::cost() const {
  return now_ ? sum(before_, now_->cost()) : before_;
}

ModelRuns& GrowingRuns::now() const {
  if (!now_) now_ = make_(effects_, grown_);
  return *now_;
}

}  // namespace tether
