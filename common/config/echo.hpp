#pragma once

#include <memory>

#include "common/config/fields.hpp"

namespace tether {

/// Writes filled sections, defaults included: the effective case. Numbers are in the case's units, paths are absolute,
/// and what is absent is left out, so that the text is itself a case file.
///   Echo echo;  echo.group("fluid", fluid_case, {});  echo.json();
class Echo : public Fields {
 public:
  Echo();
  ~Echo() override;

  std::string json() const;
  std::string yaml() const;

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
  bool enter(Text name, Text meaning) override;
  bool enter_if_given(Text name, Text meaning, bool held) override;
  void leave() override;
  std::vector<std::string> entry_names(const std::vector<std::string>& held, Need need) override;
  bool begin_when(Text field, const std::string& value, std::span<const Text> words) override;
  void end_when() override;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// {"NAME": {...}}: one section of the effective case.
template <class Section>
std::string echo_json(std::string_view name, Section section) {
  Echo echo;
  echo.group(name, section, {});
  return echo.json();
}

}  // namespace tether
