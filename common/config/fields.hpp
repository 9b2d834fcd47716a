#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/effect.hpp"
#include "common/base/types.hpp"

/// One declaration per field of a case file. A section is a plain struct whose members hold the defaults, with
///
///   void OutletCase::declare(Fields& f) {
///     f.number("compliance", compliance, dimension::compliance, range::positive, "volume stored per pressure");
///   }
///
/// `Reader` runs that declaration over a YAML file, `Echo` over a filled struct, `Describe` over a default one:
/// reading, checking, the effective case and the manual cannot disagree.
namespace tether {

enum class Need { optional, required };

/// Entries named by the user, in the order of the file: outlets, regions, points.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

/// One admissible word of a choice.
struct Word {
  std::string_view word, meaning;
};

struct IntegerRange {
  int lower = std::numeric_limits<int>::min(), upper = std::numeric_limits<int>::max();
};

Range as_range(const IntegerRange& range);

/// What a list of numbers must look like. count 0: any number of them, but at least one.
struct ListRule {
  std::size_t count = 0;
  Dimension dimension;
  Range range;
};

/// An effect as a case chooses it: a registered type, and its parameters in the order of that declaration.
/// The `type` before reading is the default one; empty: it must be given.
struct EffectCase {
  std::string type;
  std::vector<double> values;
};

using EffectFamily = std::span<const EffectDeclaration* const>;

/// Visitor of the fields of a section. A number that is `undefined` (or a text, path, list or point that is empty or
/// undefined and Need::required) must be given by the user; anything else a member holds before reading is its default.
class Fields {
 public:
  using Text = std::string_view;
  virtual ~Fields() = default;

  /// A number in the case's units; the file may carry another unit of that dimension: "80 mmHg".
  virtual void number(Text name, double& value, Dimension dimension, Range range, Text meaning) = 0;
  /// A number that may be absent.
  virtual void number(Text name, std::optional<double>& value, Dimension dimension, Range range, Text meaning) = 0;
  virtual void integer(Text name, int& value, IntegerRange range, Text meaning) = 0;
  virtual void flag(Text name, bool& value, Text meaning) = 0;
  virtual void text(Text name, std::string& value, Text meaning, Need need = Need::optional) = 0;
  /// A program: a name, or a path, which has a slash and is written relative to the case file. Read as an absolute
  /// path.
  virtual void program(Text name, std::string& value, Text meaning) { text(name, value, meaning); }
  /// One of some words. An empty value must be given.
  virtual void choice(Text name, std::string& value, std::span<const Word> words, Text meaning) = 0;
  void choice(Text name, std::string& value, std::initializer_list<Word> words, Text meaning) {
    choice(name, value, std::span(words.begin(), words.size()), meaning);
  }
  /// An existing file or folder, written relative to the case file. Read as a path that this process can open.
  virtual void path(Text name, std::filesystem::path& value, Text meaning, Need need = Need::optional) = 0;
  virtual void numbers(Text name, std::vector<double>& values, const ListRule& rule, Text meaning,
                       Need need = Need::optional) = 0;
  /// A list of words.
  virtual void texts(Text name, std::vector<std::string>& values, Text meaning, Need need = Need::optional) = 0;
  /// Three coordinates; undefined ones must be given.
  void point(Text name, Vec3& value, Dimension dimension, Text meaning);

  /// Three coordinates that are not all zero, of any length.
  void direction(Text name, Vec3& value, Text meaning);

  /// A rule between fields, checked after they were read without error: f.check(end > start, "end", "must be after
  /// start").
  virtual void check(bool holds, Text field, Text rule) = 0;

  /// A nested section.
  template <class Section>
  void group(Text name, Section& section, Text meaning) {
    if (!enter(name, meaning)) return;
    section.declare(*this);
    leave();
  }
  /// A nested section that may be absent.
  template <class Section>
  void group(Text name, std::optional<Section>& section, Text meaning) {
    if (!enter_if_given(name, meaning, section.has_value())) return;
    if (!section) section.emplace();
    section->declare(*this);
    leave();
  }
  /// Sections under names of the user's choice.
  template <class Section>
  void groups(Text name, Named<Section>& sections, Text meaning, Need need = Need::optional) {
    entries(name, sections, meaning, need, [&](Text key, Section& section) { group(key, section, {}); });
  }
  /// Paths under names of the user's choice.
  void paths(Text name, Named<std::filesystem::path>& values, Text meaning, Need need = Need::optional);
  /// Points under names of the user's choice.
  void points(Text name, Named<Vec3>& values, Dimension dimension, Text meaning, Need need = Need::optional);

  /// The fields `type` and the parameters of that type, in the CURRENT section: an effect that needs more (a file) adds
  /// it with `when`. Each member of the family must outlive the call only.
  void effect(EffectCase& effect, EffectFamily family, Text meaning);

  /// Fields that exist only where the choice `field`, read before, holds one of some words.
  template <class Body>
  void when(Text field, const std::string& value, std::initializer_list<Text> words, Body body) {
    if (!begin_when(field, value, std::span(words.begin(), words.size()))) return;
    body();
    end_when();
  }

 protected:
  /// Called where a section offers a family of effects.
  virtual void offers(EffectFamily) {}
  /// A number of a declaration, which is in SI, in the units of the fields.
  virtual double from_si(double value, Dimension) const { return value; }
  virtual bool enter(Text name, Text meaning) = 0;
  virtual bool enter_if_given(Text name, Text meaning, bool held) = 0;
  virtual void leave() = 0;
  /// The names to visit in the section just entered, given those that the struct holds.
  virtual std::vector<std::string> entry_names(const std::vector<std::string>& held, Need need) = 0;
  virtual bool begin_when(Text field, const std::string& value, std::span<const Text> words) = 0;
  virtual void end_when() = 0;

 private:
  template <class T, class Visit>
  void entries(Text name, Named<T>& values, Text meaning, Need need, Visit visit) {
    if (!enter(name, meaning)) return;
    std::vector<std::string> held;
    for (const auto& [key, value] : values) held.push_back(key);
    for (const auto& key : entry_names(held, need)) visit(key, entry(values, key));
    leave();
  }
  template <class T>
  static T& entry(Named<T>& values, const std::string& key) {
    for (auto& [known, value] : values)
      if (known == key) return value;
    if constexpr (std::is_same_v<T, Vec3>) return values.emplace_back(key, Vec3::Constant(undefined)).second;
    return values.emplace_back(key, T{}).second;
  }
};

}  // namespace tether
