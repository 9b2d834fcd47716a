#pragma once

#include <memory>

#include "common/base/units.hpp"
#include "common/config/case.hpp"

namespace tether {

/// A case file, open for reading. Each program reads the sections it owns and ends with `finish`, which reports all
/// problems:
///
///   CaseFile file(path);                    // reads the common sections as well
///   FluidCase fluid;
///   file.read("fluid", fluid);
///   file.finish();
class CaseFile {
 public:
  /// Throws InputError if the file cannot be read or is not YAML.
  explicit CaseFile(const std::filesystem::path& file);
  ~CaseFile();

  const CommonCase& common() const;
  const UnitSystem& units() const;
  const std::filesystem::path& path() const;

  /// Reads a top-level section strictly: a field that its declaration does not know is a problem.
  template <class Section>
  void read(std::string_view name, Section& section) {
    fields().group(name, section, meaning_of_section(name));
  }
  /// What the file says in a section that another program owns: "solid.element". Empty if it says nothing.
  std::string given(std::string_view field) const;

  /// Whether the file gives a field or section, with anything in it.
  bool has(std::string_view field) const;

  /// Throws InputError with a line "file:line: field: value: rule (meaning)" per problem, unknown sections included.
  void finish();

  /// "case.yaml:12: fluid.inlets.inlet", for errors that show only when the case meets its mesh. The nearest enclosing
  /// line if the file leaves the field out.
  std::string where(std::string_view field) const;

 private:
  struct Contents;

  Fields& fields();
  std::unique_ptr<Contents> contents_;
};

}  // namespace tether
