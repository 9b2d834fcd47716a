#include "common/config/fields.hpp"

#include <cmath>

namespace tether {

Range as_range(const IntegerRange& range) {
  return {range.lower == IntegerRange{}.lower ? -infinite : range.lower,
          range.upper == IntegerRange{}.upper ? infinite : range.upper};
}

void Fields::point(Text name, Vec3& value, Dimension dimension, Text meaning) {
  std::vector<double> coordinates;
  if (value.allFinite()) coordinates.assign(value.begin(), value.end());
  numbers(name, coordinates, {3, dimension, range::any}, meaning, Need::required);
  if (coordinates.size() == 3) value = Vec3(coordinates.data());
}

void Fields::direction(Text name, Vec3& value, Text meaning) {
  point(name, value, dimension::none, meaning);
  check(!value.allFinite() || value.norm() > 0, name, "must not be zero");
}

void Fields::paths(Text name, Named<std::filesystem::path>& values, Text meaning, Need need) {
  entries(name, values, meaning, need,
          [&](Text key, std::filesystem::path& value) { path(key, value, meaning, Need::required); });
}

void Fields::points(Text name, Named<Vec3>& values, Dimension dimension, Text meaning, Need need) {
  entries(name, values, meaning, need, [&](Text key, Vec3& value) { point(key, value, dimension, meaning); });
}

void Fields::effect(EffectCase& effect, EffectFamily family, Text meaning) {
  offers(family);
  std::vector<Word> words;
  for (const auto* declaration : family) words.push_back({declaration->name, declaration->meaning});
  const std::string type_before = effect.type;
  choice("type", effect.type, words, meaning);
  if (effect.type != type_before) effect.values.clear();
  for (const auto* declaration : family) {
    when("type", effect.type, {declaration->name}, [&] {
      std::vector<double> values;
      for (const Parameter& p : declaration->parameters) values.push_back(from_si(p.standard, p.dimension));
      if (effect.type == declaration->name && effect.values.size() == values.size()) values = effect.values;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Parameter& p = declaration->parameters[i];
        number(p.name, values[i], p.dimension, p.range, p.meaning);
      }
      if (effect.type == declaration->name) effect.values = values;
    });
  }
}

}  // namespace tether
