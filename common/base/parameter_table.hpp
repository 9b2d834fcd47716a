#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "common/base/effect.hpp"

namespace tether {

/// The numbers of a program that may be set by name while it runs: what identification and diagnosis can reach.
class ParameterTable {
 public:
  struct Entry {
    std::string name;  ///< its path in the case file: "solid.support.regions.spine.stiffness"
    Parameter declaration;
    std::function<double()> value;
    std::function<void(double)> set;
  };

  void add(Entry entry) { entries_.push_back(std::move(entry)); }

  /// All parameters of a configured effect, named path + "." + the parameter's name. The effect must outlive the table.
  /// `changed`: called after one of them was set.
  template <class Physics>
  void add_effect(const std::string& path, Configured<Physics>& effect, const std::function<void()>& changed = {}) {
    for (std::size_t i = 0; i < effect.declaration().parameters.size(); ++i) {
      const Parameter& parameter = effect.declaration().parameters[i];
      add({path + "." + parameter.name, parameter, [&effect, i] { return effect.values()[i]; },
           [&effect, name = parameter.name, changed](double value) {
             effect.set(name, value);
             if (changed) changed();
           }});
    }
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// Throws InputError for an unknown name (listing the known ones), a value that is not finite or out of range.
  void set(const std::string& name, double value) const;

  /// Several at once, or none of them: names and values are checked before the first is set.
  void set(const std::vector<std::string>& names, const std::vector<double>& values) const;

  /// All values in the table's order, and back.
  std::vector<double> values() const;

 private:
  /// Throws InputError.
  const Entry& checked(const std::string& name, double value) const;

  std::vector<Entry> entries_;
};

/// "linear", "log", "log2" or "bounded".
std::string name_of(Transform transform);

}  // namespace tether
