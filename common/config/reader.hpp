#pragma once

#include <map>

#include "common/base/units.hpp"
#include "common/config/fields.hpp"
#include "common/config/yaml_tree.hpp"

namespace tether {

/// What is wrong with a file, collected so that the user sees all of it at once.
class Problems {
 public:
  /// Control characters of what a file says are told as ?, lest a terminal obeys them.
  void add(const YamlPlace& place, std::string text);
  bool empty() const { return found_.empty(); }
  /// More than anybody reads: only their number is told.
  bool are_many() const { return found_.size() > most_told; }
  /// Throws InputError with one line "file:line: text" per problem, in the order of the file, a file before the one
  /// that it builds on.
  void throw_if_any();

 private:
  static constexpr std::size_t most_told = 50;
  std::vector<std::pair<YamlPlace, std::string>> found_;
};

/// Reads declared fields from a YAML tree; everything that breaks a declaration is added to `problems`. Paths are
/// relative to the file that they stand in.
class Reader : public Fields {
 public:
  /// All references must outlive the reader.
  Reader(const YamlNode& root, const UnitSystem& units, Problems& problems);

  void number(Text name, double& value, Dimension dimension, Range range, Text meaning) override;
  void number(Text name, std::optional<double>& value, Dimension dimension, Range range, Text meaning) override;
  void integer(Text name, int& value, IntegerRange range, Text meaning) override;
  void flag(Text name, bool& value, Text meaning) override;
  void text(Text name, std::string& value, Text meaning, Need need) override;
  void choice(Text name, std::string& value, std::span<const Word> words, Text meaning) override;
  void program(Text name, std::string& value, Text meaning) override;
  void path(Text name, std::filesystem::path& value, Text meaning, Need need) override;
  void numbers(Text name, std::vector<double>& values, const ListRule& rule, Text meaning, Need need) override;
  void texts(Text name, std::vector<std::string>& values, Text meaning, Need need) override;
  void check(bool holds, Text field, Text rule) override;
  /// Of the whole tree: to be called last, where all of it was read by one declaration.
  void report_unknown() { report_unknown(sections_.back()); }

 protected:
  double from_si(double value, Dimension dimension) const override { return units_.from_si(value, dimension); }
  bool enter(Text name, Text meaning) override;
  bool enter_if_given(Text name, Text meaning, bool held) override;
  void leave() override;
  std::vector<std::string> entry_names(const std::vector<std::string>& held, Need need) override;
  bool begin_when(Text field, const std::string& value, std::span<const Text> words) override;
  void end_when() override;

 private:
  /// A field as messages name it.
  struct Field {
    Text name, meaning;
    std::string unit;  ///< empty for none
    bool required = false;
  };
  /// A `when` around the fields being read, and whether it holds.
  struct Condition {
    bool holds;
    std::string field, chosen, words;
    int depth;  ///< of the file that makes the choice
  };
  /// The section being read; `node` is null where the file leaves the section out.
  struct Section {
    const YamlNode* node = nullptr;
    std::string path;  ///< with its final dot: "solid.support."
    YamlPlace place;
    std::string meaning;
    std::vector<std::string> known;
    std::map<std::string, Condition> inapplicable;  ///< field -> where it would apply
    bool failed = false;
  };
  std::string unit(Dimension dimension) const;
  const Condition* broken_condition() const;
  const YamlNode* find(const Field& field);
  const YamlNode* scalar(const Field& field);
  std::optional<double> quantity(const Field& field, const YamlNode& node, Dimension dimension, const Range& range);
  void wrong(const Field& field, const YamlPlace& place, const std::string& value, const std::string& rule);
  static std::string only_with(const Condition& condition);
  static bool is_moot(const Condition& condition, const YamlNode::Entry& entry);
  void report_unknown(const Section& section);

  const UnitSystem& units_;
  Problems& problems_;
  std::vector<Section> sections_;
  std::vector<Condition> conditions_;
};

}  // namespace tether
