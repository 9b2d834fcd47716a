#include "diagnosis/comparison/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

constexpr double false_alarms = 0.05;  ///< of all tests of a source together
constexpr double missed = 0.05;        ///< of offsets that are called visible

/// What one region says at one moment.
enum class Finding { within_noise, outward, inward, scattered };

Finding finding(const Group& group, const Noise& noise, double limit) {
  const double z = significance(group, noise), square = std::pow(group.model.rms / noise.deviation, 2);
  if (std::abs(z) > limit) return z > 0 ? Finding::inward : Finding::outward;
  return square > mean_square_quantile(group.effective, limit) ? Finding::scattered : Finding::within_noise;  // (D.4)
}

bool shifted(Finding finding) {
  return finding == Finding::inward || finding == Finding::outward;
}

/// The regions that are judged: all of the wall's, or the wall as a whole if it has none.
std::vector<int> judged_regions(const SourceDiscrepancy& source) {
  if (source.regions.empty()) return {-1};
  std::vector<int> regions;
  for (std::size_t r = 0; r < source.regions.size(); ++r) regions.push_back(static_cast<int>(r));
  return regions;
}

/// Calls `look` with the moments of a kind in which a region was observed.
template <class Look>
void for_each_test(const SourceDiscrepancy& source, bool held_out, int region, const Look& look) {
  for (const Moment& moment : source.moments)
    if (const Group* group = group_of_region(moment, region);
        moment.held_out == held_out && group != nullptr && group->model.used() > 0)
      look(moment, *group);
}

void take_in(Failure& failure, const Moment& moment, const Group& group, Finding found, const Noise& noise) {
  Failure now{group.region,   failure.first,    moment.time,     moment.time,
              shifted(found), group.model.mean, group.model.rms, significance(group, noise)};
  failure.last = moment.time;
  const bool larger = now.shifted == failure.shifted ? now.size() > failure.size() : now.shifted;
  if (larger) failure = now;
}

/// Consecutive findings become one failure; from inward to outward begins another.
void add_failures(Judgement& verdict, const SourceDiscrepancy& source, bool held_out, int region) {
  Failure* open = nullptr;
  Finding direction = Finding::scattered;
  for_each_test(source, held_out, region, [&](const Moment& moment, const Group& group) {
    const Finding found = finding(group, source.noise, verdict.limit);
    if (found == Finding::within_noise) {
      open = nullptr;
      return;
    }
    const bool turned = shifted(found) && shifted(direction) && found != direction;
    if (open == nullptr || turned) {
      open = &verdict.failures.emplace_back();
      open->region = region;
      open->first = moment.time;
      direction = found;
    }
    if (shifted(found)) direction = found;
    take_in(*open, moment, group, found, source.noise);
  });
}

std::string period_text(const Failure& f) {
  return f.first == f.last ? fmt::format("{:.3g} s", f.first) : fmt::format("{:.3g}-{:.3g} s", f.first, f.last);
}

std::string offset_text(double mean, const UnitSystem& units) {
  return fmt::format("the model lies {:.2g} mm too far {}", units.to_mm(std::abs(mean)),
                     mean > 0 ? "inward" : "outward");
}

/// Where the mean signed distance is largest, whatever the noise.
std::string farthest(const SourceDiscrepancy& source, bool held_out, const UnitSystem& units) {
  double largest = -1;
  std::string text;
  for (const int region : judged_regions(source))
    for_each_test(source, held_out, region, [&](const Moment& moment, const Group& group) {
      if (std::abs(group.model.mean) <= largest) return;
      largest = std::abs(group.model.mean);
      text = fmt::format("{}, {:.3g} s: {}", region_name(source, region), moment.time,
                         offset_text(group.model.mean, units));
    });
  return text;
}

std::string nothing_seen(const Judgement& verdict, const UnitSystem& units) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const auto& [region, offset] : verdict.visible)
    smallest = std::min(smallest, offset), largest = std::max(largest, offset);
  return fmt::format(
      "in all {} pairs of region and frame the model is within the noise; a region's offset of {:.2g} to {:.2g} mm in "
      "one frame would "
      "have been seen",
      verdict.tests, units.to_mm(smallest), units.to_mm(largest));
}

/// The largest failure of each region that is not among `named`.
std::vector<const Failure*> largest_of_other_regions(const Judgement& verdict, const std::set<int>& named) {
  std::map<int, const Failure*> largest;
  for (const Failure& failure : verdict.failures) {
    const Failure*& kept = largest[failure.region];
    if (kept == nullptr || failure.size() > kept->size()) kept = &failure;
  }
  std::vector<const Failure*> others;
  for (const auto& [region, failure] : largest)
    if (!named.contains(region)) others.push_back(failure);
  return others;
}

}  // namespace

double Failure::size() const {
  return shifted ? std::abs(mean) : rms;
}

Judgement judge(const SourceDiscrepancy& source, bool held_out) {
  Judgement verdict;
  if (source.noise.deviation <= 0) return verdict;
  for (const int region : judged_regions(source))
    for_each_test(source, held_out, region, [&](const Moment&, const Group&) { ++verdict.tests; });
  if (verdict.tests == 0) return verdict;
  verdict.limit = normal_quantile(1 - false_alarms / (4.0 * verdict.tests));  // (D.4)
  const double margin = verdict.limit + normal_quantile(1 - missed);
  for (const int region : judged_regions(source)) {
    double fewest = std::numeric_limits<double>::infinity();
    for_each_test(source, held_out, region,
                  [&](const Moment&, const Group& group) { fewest = std::min(fewest, group.effective); });
    if (std::isfinite(fewest))
      verdict.visible.emplace_back(region, margin * source.noise.deviation / std::sqrt(fewest));  // (D.5)
    add_failures(verdict, source, held_out, region);
  }
  std::stable_sort(verdict.failures.begin(), verdict.failures.end(),
                   [](const Failure& a, const Failure& b) { return a.first < b.first; });
  return verdict;
}

const Failure* first_of(const Judgement& verdict) {
  const auto& all = verdict.failures;
  const auto first = std::min_element(all.begin(), all.end(), [](const Failure& a, const Failure& b) {
    return std::pair(a.first, -a.size()) < std::pair(b.first, -b.size());
  });
  return first == all.end() ? nullptr : &*first;
}

const Failure* worst_of(const Judgement& verdict) {
  const auto& all = verdict.failures;
  const auto worst =
      std::max_element(all.begin(), all.end(), [](const Failure& a, const Failure& b) { return a.size() < b.size(); });
  return worst == all.end() ? nullptr : &*worst;
}

std::string sentence_of(const Failure& failure, const SourceDiscrepancy& source, const UnitSystem& units) {
  const std::string where = fmt::format("{}, {}: ", region_name(source, failure.region), period_text(failure));
  if (failure.shifted)
    return where + fmt::format("{} ({:.1f} sigma)", offset_text(failure.mean, units), std::abs(failure.z));
  return where + fmt::format("the model is {:.2g} mm off both ways (root mean square; {:.1f} times the noise)",
                             units.to_mm(failure.rms), failure.rms / source.noise.deviation);
}

std::vector<std::string> sentences_of(const Judgement& verdict, const SourceDiscrepancy& source, bool held_out,
                                      const UnitSystem& units) {
  const std::string name = source.name + (held_out ? ", held-out frames" : "");
  const std::string largest = farthest(source, held_out, units);
  if (largest.empty()) return {};
  if (verdict.tests == 0)
    return {
        fmt::format("{}: no noise is stated, so nothing can be called significant; farthest off: {}", name, largest)};
  if (verdict.failures.empty()) return {fmt::format("{}: {}", name, nothing_seen(verdict, units))};
  const Failure *first = first_of(verdict), *worst = worst_of(verdict);
  std::vector<std::string> all{fmt::format("{}: {}", name, sentence_of(*worst, source, units))};
  if (first != worst) all.push_back(fmt::format("{}, first: {}", name, sentence_of(*first, source, units)));
  for (const Failure* other : largest_of_other_regions(verdict, {first->region, worst->region}))
    all.push_back(fmt::format("{}, also: {}", name, sentence_of(*other, source, units)));
  return all;
}

}  // namespace tether
