#include "diagnosis/search/patch_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "diagnosis/search/spread_points.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double still_possible = 3.5;  ///< logarithm of evidence, as where runs are wanted (wanted_runs.cpp)
constexpr double alike = 0.5;           ///< squared cosine of two that do much the same
constexpr double much = 0.5;            ///< probability of a group; share of a patch
constexpr std::size_t most_told = 30;   ///< patches
constexpr Index around = 6;
constexpr double wider = std::numbers::sqrt2;  ///< of sizes that are compared: half or twice the area

/// What acts on regions, each type once: of the catalogue, and what only the model has.
std::vector<PlacedEffect> laws_on_regions(const std::vector<PlacedEffect>& effects) {
  std::set<std::string> divided, known;
  for (const PlacedEffect& effect : effects)  // rings and the surroundings as such have no parts
    if (!effect.extent.is_all()) divided.insert(effect.part);
  divided.erase("");
  std::vector<PlacedEffect> laws;
  for (const bool is_new : {true, false})
    for (const PlacedEffect& effect : effects)
      if (effect.is_new == is_new && divided.contains(effect.part) && known.insert(effect.type).second)
        laws.push_back({"", effect.type, "", is_new ? effect.meaning : "As the model has it elsewhere", true,
                        effect.required, effect.variant_of});
  return laws;
}

bool is_one_of(const std::vector<PlacedEffect>& laws, const Candidate& candidate) {
  const auto is_it = [&](const PlacedEffect& law) { return law.type == candidate.type; };
  return !candidate.part.empty() && candidate.amplitudes.size() == 1 && std::any_of(laws.begin(), laws.end(), is_it);
}

/// First members of groups that are more probable than not.
std::vector<std::size_t> leading_in(const Weighed& weighed) {
  constexpr std::size_t most = 2;  // a patch is the third
  std::vector<std::size_t> all;
  for (const WeighedGroup& group : weighed.groups)
    if (group.probability > much && all.size() < most) all.push_back(group.members.front());
  return all;
}

/// Of a candidate and of what leads, but for what does much the same.
double evidence_of(std::size_t candidate, std::vector<std::size_t> leading, const SetEvidence& evidence) {
  std::erase_if(leading, [&](std::size_t member) { return std::pow(evidence.cosine(candidate, member), 2) > alike; });
  leading.push_back(candidate);
  return evidence.fit(leading, 0).log_evidence;
}

/// The region that holds most of a ball's nodes; empty if none does.
std::string region_of_most(const Ball& ball, const LumenSurface& lumen, const VectorXd& areas) {
  std::map<int, double> shares;
  double sum = 0;
  for (Index i = 0; i < lumen.points.cols(); ++i) {
    if ((lumen.points.col(i) - ball.centre).norm() > ball.radius) continue;
    shares[lumen.region[static_cast<std::size_t>(i)]] += areas[i];
    sum += areas[i];
  }
  for (const auto& [region, share] : shares)
    if (region >= 0 && share > much * sum) return lumen.region_names[static_cast<std::size_t>(region)];
  return {};
}

}  // namespace

PatchSearch::PatchSearch(const std::vector<PlacedEffect>& effects, const LumenSurface& lumen, std::string length)
    : laws_(laws_on_regions(effects)),
      lumen_(lumen),
      length_(std::move(length)),
      areas_(nodal_areas(lumen.points, lumen.triangles)) {
  for (const PlacedEffect& effect : effects) paths_.insert(effect.path);
}

std::vector<PatchEffect> PatchSearch::next(const EffectProblem& problem, const Weighing& weighing,
                                           const LocatedMisfit& left) {
  if (stage_ == Stage::done) return {};
  const SetEvidence evidence(problem, weighing.shown);
  if (stage_ == Stage::not_begun) {
    begin(problem, evidence, left);
    if (law_.empty()) return {};
    stage_ = Stage::moving;
    std::vector<PatchEffect> wanted = neighbours();
    wanted.push_back(told(law_, best_, number_));
    return wanted;
  }
  if (!find_best(problem, evidence, leading_in(weighing.weighed))) {
    stage_ = Stage::done;
    return {};
  }
  for (; step_ > best_.radius / 4 && told_.size() < most_told; step_ /= 2)
    if (std::vector<PatchEffect> wanted = neighbours(); !wanted.empty()) return wanted;
  stage_ = Stage::done;
  return other_laws();
}

void PatchSearch::begin(const EffectProblem& problem, const SetEvidence& evidence, const LocatedMisfit& left) {
  double most = -infinite;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    const Candidate& candidate = problem.candidates[c];
    if (!is_one_of(laws_, candidate)) continue;
    const double gain = evidence.fit({c}, 0).log_evidence;
    if (gain <= most) continue;
    most = gain;
    law_ = candidate.type;
    number_ = candidate.number;
  }
  best_ = {left.centre, left.radius};
  step_ = left.radius;
}

bool PatchSearch::find_best(const EffectProblem& problem, const SetEvidence& evidence,
                            const std::vector<std::size_t>& leading) {
  double most = evidence.fit(leading, 0).log_evidence - still_possible;
  bool any = false;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    const Candidate& candidate = problem.candidates[c];
    if (!candidate.extent.about || candidate.type != law_ || candidate.number != number_) continue;
    const double gain = evidence_of(c, leading, evidence);
    if (gain <= most) continue;
    any = true;
    most = gain;
    best_ = *candidate.extent.about;
  }
  return any;
}

std::vector<PatchEffect> PatchSearch::neighbours() {
  constexpr double nearer = 0.7, farther = 1.3;  // of a step
  const VectorXd away = (lumen_.points.colwise() - best_.centre).colwise().norm();
  std::vector<Index> at_a_step;
  for (Index i = 0; i < away.size(); ++i)
    if (away[i] > nearer * step_ && away[i] < farther * step_) at_a_step.push_back(i);
  std::vector<PatchEffect> wanted;
  const auto want = [&](const Ball& ball) {
    if (!is_known(ball)) wanted.push_back(told(law_, ball, number_));
  };
  const Points places = spread(lumen_.points(Eigen::all, at_a_step), around);
  for (const auto& place : places.colwise()) want({place, best_.radius});
  const double smallest = std::sqrt(areas_.mean());
  if (best_.radius / wider > smallest) want({best_.centre, best_.radius / wider});
  want({best_.centre, best_.radius * wider});
  return wanted;
}

std::vector<PatchEffect> PatchSearch::other_laws() {
  std::vector<PatchEffect> wanted;
  for (const PlacedEffect& law : laws_) wanted.push_back(told(law.type, best_, {}));
  return wanted;
}

PatchEffect PatchSearch::told(const std::string& type, const Ball& ball, const std::string& number) {
  const auto law = std::find_if(laws_.begin(), laws_.end(), [&](const PlacedEffect& one) { return one.type == type; });
  PatchEffect result{*law, number};
  int count = 1;
  do result.effect.path = fmt::format("solid.effects.{}_patch_{}", type, count++);
  while (!paths_.insert(result.effect.path).second);
  result.effect.extent.about = ball;
  result.effect.length = length_;
  result.effect.mostly_in = region_of_most(ball, lumen_, areas_);
  result.effect.one_of = std::max(1.0, areas_.sum() / (std::numbers::pi * ball.radius * ball.radius));
  told_.push_back(ball);
  return result;
}

bool PatchSearch::is_known(const Ball& ball) const {
  constexpr double same = 1.2;  // a size
  return std::any_of(told_.begin(), told_.end(), [&](const Ball& known) {
    const double ratio = std::max(known.radius / ball.radius, ball.radius / known.radius);
    return (known.centre - ball.centre).norm() < 0.4 * step_ && ratio < same;
  });
}

}  // namespace tether
