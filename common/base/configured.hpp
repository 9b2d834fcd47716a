#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/base/effect.hpp"
#include "common/base/error.hpp"

namespace tether {

/// What a case says about one effect: which one, and the values it gives. Values left out take their standard, which is
/// in SI: case files state all values, in their own units.
struct EffectChoice {
  std::string type;
  std::map<std::string, double> values;
};

/// The entry of a registry by name. Throws InputError that lists the known ones.
template <class Physics>
const Registered<Physics>& find_effect(std::span<const Registered<Physics>> registry, const std::string& name) {
  std::string known;
  for (const auto& entry : registry) {
    if (entry.declaration.name == name) return entry;
    known += (known.empty() ? "" : ", ") + entry.declaration.name;
  }
  throw input_error("there is no effect \"{}\"; known are: {}", name, known);
}

/// The declarations of a registry, for the case file's reader.
template <class Physics>
std::vector<const EffectDeclaration*> declarations(std::span<const Registered<Physics>> registry) {
  std::vector<const EffectDeclaration*> result;
  for (const auto& entry : registry) result.push_back(&entry.declaration);
  return result;
}

/// An effect with its values: remade when one of them is set, so that the point functions themselves stay constant.
template <class Physics>
class Configured {
 public:
  /// Throws InputError for an unknown type or name, a value out of range, or one that must be given and is not.
  Configured(std::span<const Registered<Physics>> registry, const EffectChoice& choice)
      : Configured(find_effect(registry, choice.type)) {
    for (const auto& parameter : declaration().parameters) {
      const auto given = choice.values.find(parameter.name);
      values_.push_back(given == choice.values.end() ? parameter.standard : given->second);
      check(parameter, values_.back());
    }
    for (const auto& [name, value] : choice.values) index_of(name);
    physics_ = make_(values_);
  }

  /// Values in the declaration's order, as the case file's reader leaves them.
  Configured(std::span<const Registered<Physics>> registry, const std::string& type, std::vector<double> values)
      : Configured(find_effect(registry, type)) {
    start_with(std::move(values));
  }

  /// An effect whose declaration the case itself makes.
  Configured(std::shared_ptr<const EffectDeclaration> declaration,
             std::function<std::unique_ptr<Physics>(std::span<const double>)> make, std::vector<double> values)
      : declaration_(std::move(declaration)), make_(std::move(make)) {
    start_with(std::move(values));
  }

  const Physics& operator*() const { return *physics_; }
  const Physics* operator->() const { return physics_.get(); }
  const EffectDeclaration& declaration() const { return *declaration_; }
  /// Whether all parameters that can switch the effect off do so. An effect without any is never absent.
  bool is_absent() const {
    bool any = false;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double absent = declaration().parameters[i].absent;
      if (absent != absent) continue;
      if (values_[i] != absent) return false;
      any = true;
    }
    return any;
  }
  /// In the declaration's order.
  const std::vector<double>& values() const { return values_; }

  void set(const std::string& name, double value) {
    const std::size_t index = index_of(name);
    check(declaration().parameters[index], value);
    values_[index] = value;
    physics_ = make_(values_);
  }

 private:
  explicit Configured(const Registered<Physics>& entry)
      : declaration_(std::shared_ptr<void>(), &entry.declaration), make_(entry.make) {}

  void start_with(std::vector<double> values) {
    values_ = std::move(values);
    TETHER_ASSERT(values_.size() == declaration().parameters.size(), "{} values for {}", values_.size(),
                  declaration().name);
    for (std::size_t i = 0; i < values_.size(); ++i) check(declaration().parameters[i], values_[i]);
    physics_ = make_(values_);
  }
  std::size_t index_of(const std::string& name) const {
    const auto& list = declaration().parameters;
    const auto found = std::find_if(list.begin(), list.end(), [&](const Parameter& p) { return p.name == name; });
    if (found == list.end()) throw input_error("{} has no parameter \"{}\"", declaration().name, name);
    return static_cast<std::size_t>(found - list.begin());
  }
  void check(const Parameter& parameter, double value) const {
    if (value != value) throw input_error("{}.{} must be given", declaration().name, parameter.name);
    if (!parameter.range.contains(value))
      throw input_error("{}.{}: {} is out of range", declaration().name, parameter.name, value);
  }

  std::shared_ptr<const EffectDeclaration> declaration_;  ///< a registered one lives as long as the program
  std::function<std::unique_ptr<Physics>(std::span<const double>)> make_;
  std::vector<double> values_;
  std::unique_ptr<Physics> physics_;
};

}  // namespace tether
