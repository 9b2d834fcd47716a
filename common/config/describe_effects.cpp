#include "common/config/describe_effects.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/parameter_table.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

std::string shown(double value) {
  return std::isnan(value) ? "" : fmt::format("{:.4g}", value);
}

std::string rule_in_words(const Range& range) {
  const std::string rule = rule_of(range);
  if (rule.starts_with("must not be ")) return "not " + rule.substr(12);
  return rule.starts_with("must be ") ? rule.substr(8) : rule;
}

const char* words_of(Place place) {
  switch (place) {
    case Place::wall:
      return "inside the wall";
    case Place::outer_wall:
      return "on the outer wall";
    case Place::ring:
      return "on an end ring";
    case Place::interface:
      return "between blood and wall";
    case Place::blood:
      return "in the blood";
    case Place::inlet:
      return "at an inlet";
    case Place::outlet:
      return "at an outlet";
    case Place::data:
      return "in the measurements";
  }
  return "";
}

std::string role_of(const EffectDeclaration& effect) {
  std::string text = fmt::format("Role: {}", name_of(effect.role));
  if (effect.target == EffectTarget::whole) text += ", on the whole at once";
  if (!effect.variant_of.empty()) text += fmt::format(", a variant of `{}`", effect.variant_of);
  return text + (effect.generic ? ", generic" : "");
}

}  // namespace

void DescribeEffects::offers(EffectFamily family) {
  for (const EffectDeclaration* effect : family) {
    auto known =
        std::find_if(offers_.begin(), offers_.end(), [&](const Offer& offer) { return offer.effect == effect; });
    if (known == offers_.end()) known = offers_.insert(offers_.end(), {effect, {}});
    const std::string here = "`" + section() + "`";
    if (std::find(known->sections.begin(), known->sections.end(), here) == known->sections.end())
      known->sections.push_back(here);
  }
}

std::string DescribeEffects::row_of(const Parameter& p) const {
  const bool linear = p.transform == Transform::linear;
  const double deviation = linear ? units_.from_si(p.prior_deviation, p.dimension) : p.prior_deviation;
  const double scale = linear && std::isnan(p.scale) ? p.prior_deviation : p.scale;
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n", p.name, units_.symbol(p.dimension),
                     rule_in_words(p.range), shown(units_.from_si(p.standard, p.dimension)), shown(p.absent),
                     name_of(p.transform), shown(deviation), shown(units_.from_si(scale, p.dimension)), p.meaning);
}

std::string DescribeEffects::table_of(const EffectDeclaration& effect) const {
  if (effect.parameters.empty()) return "";
  std::string rows =
      "\n| parameter | unit | allowed | default | absent | transform | prior deviation | scale | meaning |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Parameter& p : effect.parameters) rows += row_of(p);
  return rows;
}

std::string DescribeEffects::markdown() const {
  std::string out;
  for (const Offer& offer : offers_)
    out += fmt::format("## {}: {}\n\n{}. As `type` of {}. {}.\n{}\n", words_of(offer.effect->place), offer.effect->name,
                       offer.effect->meaning, fmt::join(offer.sections, ", "), role_of(*offer.effect),
                       table_of(*offer.effect));
  return out;
}

}  // namespace tether
