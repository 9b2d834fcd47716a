#include "diagnosis/comparison/comparison_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tether {
namespace {

std::string row(const Group& group, const SourceDiscrepancy& source, const UnitSystem& units) {
  const auto mm = [&](double length) { return units.to_mm(length); };
  const Statistics &m = group.model, &a = group.apparent;
  return fmt::format("  {:<16} {:6.2f} {:6.2f} {:6.2f} {:8.2f}   {:6.2f} {:6.2f}\n", region_name(source, group.region),
                     mm(m.rms), mm(m.mean), mm(m.p95), mm(m.largest), mm(a.rms), mm(a.mean));
}

/// Of all samples those without a distance, by reason.
std::string left_out(const Statistics& s) {
  std::string text;
  for (std::size_t why = 1; why < exclusion_count; ++why)
    if (s.counts[why] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", s.counts[why], meaning_of(static_cast<Exclusion>(why)));
  return text.empty() ? "" : fmt::format("  places without a distance, beside {} with one: {}\n", s.used(), text);
}

std::string table(const SourceDiscrepancy& source, bool held_out, const UnitSystem& units) {
  const auto& all = source.moments;
  const auto moments = std::count_if(all.begin(), all.end(), [&](const Moment& m) { return m.held_out == held_out; });
  if (moments == 0) return {};
  std::string text = fmt::format("{}{}, {} times [mm]\n", source.name, held_out ? ", held out" : "", moments);
  text += fmt::format("  {:<16} {:>6} {:>6} {:>6} {:>8}   data's own motion: rms, mean\n", "region", "rms", "mean",
                      "p95", "largest");
  for (const Group& group : held_out ? source.held_out : source.training)
    if (group.series < 0 && group.model.used() > 0) text += row(group, source, units);
  return text + left_out((held_out ? source.held_out : source.training).front().model);
}

}  // namespace

std::string text_of(const Comparison& comparison) {
  std::string text;
  for (const std::string& sentence : sentences_of(comparison)) text += sentence + "\n";
  for (const SourceDiscrepancy& source : comparison.sources) {
    for (const std::string& note : source.notes) text += fmt::format("{}: {}\n", source.name, note);
    for (const bool held_out : {false, true}) text += table(source, held_out, comparison.units);
  }
  return text + "Mean distances are signed: positive where the data lie outside the model.\n";
}

}  // namespace tether
