#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tether {

/// What a case says otherwise than the one it builds on.
struct Overlay {
  struct Value {
    std::string field;  ///< "solid.support.regions.spine.stiffness": names without dots of their own
    std::string text;   ///< as in a case file: "9.8e5", "80 mmHg", "[0, 1]"; empty: removes what the base says
  };
  std::filesystem::path base;
  std::string name, title;  ///< an empty title: the base's
  std::vector<Value> values;
};

/// The text of a number from which exactly that number is read again.
std::string number_text(double value);

/// Writes a case file that builds on `overlay.base`, which is named relative to the new file's folder. Throws
/// InputError: a field without a name, given twice, or within another; a text that is not YAML; a file that cannot be
/// written.
void write_overlay(const std::filesystem::path& file, const Overlay& overlay);

/// What a case file says beside `base`, `name` and `title`, its base not asked. Throws InputError.
std::vector<Overlay::Value> values_of_overlay(const std::filesystem::path& file);

/// Sets a field, in the place where the list has it already, else at its end.
void set_value(std::vector<Overlay::Value>& values, const Overlay::Value& value);

}  // namespace tether
