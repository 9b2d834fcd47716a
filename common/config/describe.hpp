#pragma once

#include "common/base/units.hpp"
#include "common/config/fields.hpp"

namespace tether {

/// Collects what there is to say of each field of a default section: the reference page and --describe-config.
///   Describe reference(UnitSystem::cgs());  FluidCase sample;  reference.group("fluid", sample, "the blood");
///   reference.text();
class Describe : public Fields {
 public:
  explicit Describe(const UnitSystem& units) : units_(units) {}

  /// For a terminal: a line of facts and a line of meaning per field.
  std::string text() const;
  /// One table per top-level section.
  std::string markdown() const;

  void number(Text name, double& value, Dimension dimension, Range range, Text meaning) override;
  void number(Text name, std::optional<double>& value, Dimension dimension, Range range, Text meaning) override;
  void integer(Text name, int& value, IntegerRange range, Text meaning) override;
  void flag(Text name, bool& value, Text meaning) override;
  void text(Text name, std::string& value, Text meaning, Need need) override;
  void choice(Text name, std::string& value, std::span<const Word> words, Text meaning) override;
  void path(Text name, std::filesystem::path& value, Text meaning, Need need) override;
  void numbers(Text name, std::vector<double>& values, const ListRule& rule, Text meaning, Need need) override;
  void texts(Text name, std::vector<std::string>& values, Text meaning, Need need) override;
  void check(bool holds, Text field, Text rule) override;

 protected:
  /// The path of the section being declared: "solid.rings.NAME".
  std::string section() const { return path_.empty() ? "" : path_.substr(0, path_.size() - 1); }
  double from_si(double value, Dimension dimension) const override { return units_.from_si(value, dimension); }
  bool enter(Text name, Text meaning) override;
  bool enter_if_given(Text name, Text meaning, bool held) override;
  void leave() override;
  std::vector<std::string> entry_names(const std::vector<std::string>& held, Need need) override;
  bool begin_when(Text field, const std::string& value, std::span<const Text> words) override;
  void end_when() override;

 private:
  struct Line {
    std::string path;
    std::string kind;      ///< "number", "section", ...
    std::string unit;      ///< empty for none
    std::string standard;  ///< "default 0.2", "must be given", "may be absent"
    std::string rule;      ///< empty for none
    std::string meaning;
    std::vector<std::string> words;  ///< of a choice, each with its meaning
    std::string condition;           ///< "with type: moving"; empty: always
  };
  void add(Text name, Line line, Text meaning);
  void go_into(Text name);
  static std::string heading(const Line& line);
  std::string unit(Dimension dimension) const;

  UnitSystem units_;
  std::string path_;
  std::vector<std::string> conditions_;                     ///< of the fields being declared, within their section
  std::vector<std::vector<std::string>> outer_conditions_;  ///< of the sections around
  std::vector<Line> lines_;
};

}  // namespace tether
