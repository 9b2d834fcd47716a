#pragma once

#include "observation_manager/measurements/faults/fault.hpp"

namespace tether {

/// Every fault that data can have, with what a case says of each: a value.
class Faults {
 public:
  Faults();                               ///< all of them
  explicit Faults(const Fallible& data);  ///< those that concern such data
  Faults(const Faults& other);
  Faults& operator=(const Faults& other);
  Faults(Faults&&) = default;
  Faults& operator=(Faults&&) = default;

  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  bool empty() const { return all_.empty(); }

  // Taken off.
  void declare_corrections(Fields& f, Dimension of_values);
  Points corrected(Points points) const;
  double outward() const;  ///< [length]
  void correct(std::vector<double>& values) const;
  std::vector<std::string> notes(const std::string& unit_of_length) const;
  /// What a source must say (fields within it) so that what a diagnosis calls `name` is off. Nothing if it cannot be.
  std::vector<Overlay::Value> take_off(const std::string& name, FoundFault found) const;

  // Made by a twin.
  void declare(Fields& f, Dimension of_values = dimension::length);
  /// Throws InputError; where: "case.yaml:9: twin.faults".
  void check(int frames, const std::string& where) const;
  bool lose(int frame) const;
  double delay(int frame) const;  ///< [time]
  double moved_outward() const;   ///< [length]
  void spoil(TriangleSurface& surface, const TriangleSurface& truth, int frame) const;
  void spoil(std::vector<double>& values) const;

 private:
  std::vector<std::unique_ptr<Fault>> all_;
};

}  // namespace tether
