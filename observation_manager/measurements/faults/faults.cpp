#include "observation_manager/measurements/faults/faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "observation_manager/measurements/faults/registry.hpp"

namespace tether {

Faults::Faults() {
  for (const MakeFault& make : data_faults()) all_.push_back(make());
}

Faults::Faults(const Fallible& data) : Faults() {
  std::erase_if(all_, [&](const auto& fault) { return !fault->declaration().concerns(data); });
}

Faults::Faults(const Faults& other) {
  for (const auto& fault : other.all_) all_.push_back(fault->copy());
}

Faults& Faults::operator=(const Faults& other) {
  return *this = Faults(other);
}

void Faults::declare_corrections(Fields& f, Dimension of_values) {
  for (const auto& fault : all_) fault->declare_correction(f, of_values);
}

Points Faults::corrected(Points points) const {
  for (auto fault = all_.rbegin(); fault != all_.rend(); ++fault) points = (*fault)->corrected(std::move(points));
  return points;
}

double Faults::outward() const {
  double sum = 0;
  for (const auto& fault : all_) sum += fault->outward();
  return sum;
}

void Faults::correct(std::vector<double>& values) const {
  for (auto fault = all_.rbegin(); fault != all_.rend(); ++fault)
    for (double& value : values) value = (*fault)->corrected_value(value);
}

std::vector<std::string> Faults::notes(const std::string& unit_of_length) const {
  std::vector<std::string> all;
  for (auto fault = all_.rbegin(); fault != all_.rend(); ++fault)
    if (const std::string note = (*fault)->note(unit_of_length); !note.empty()) all.push_back("corrected: " + note);
  if (outward() != 0) all.push_back(fmt::format("corrected: moved outward by {:.3g} {}", outward(), unit_of_length));
  return all;
}

std::vector<Overlay::Value> Faults::take_off(const std::string& name, FoundFault found) const {
  for (const auto& fault : all_) {
    if (fault->declaration().of_all.name == name) return fault->take_off(found);
    found.middle = fault->uncorrected(found.middle);  // which is corrected after those that follow
  }
  return {};
}

void Faults::declare(Fields& f, Dimension of_values) {
  for (const auto& fault : all_) fault->declare_made(f, of_values);
}

void Faults::check(int frames, const std::string& where) const {
  for (const auto& fault : all_) fault->check_made(frames, where);
}

bool Faults::lose(int frame) const {
  return std::any_of(all_.begin(), all_.end(), [&](const auto& fault) { return fault->loses(frame); });
}

double Faults::delay(int frame) const {
  double sum = 0;
  for (const auto& fault : all_) sum += fault->delay(frame);
  return sum;
}

double Faults::moved_outward() const {
  double sum = 0;
  for (const auto& fault : all_) sum += fault->moved_outward();
  return sum;
}

void Faults::spoil(TriangleSurface& surface, const TriangleSurface& truth, int frame) const {
  for (const auto& fault : all_) fault->spoil(surface, truth, frame);
}

void Faults::spoil(std::vector<double>& values) const {
  for (const auto& fault : all_)
    for (double& value : values) value = fault->spoilt_value(value);
}

}  // namespace tether
