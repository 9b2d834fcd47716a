#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/config/fields.hpp"

namespace tether {

class CaseFile;
struct CorrectionCase;
struct FlowObservations;
struct LumenSurface;
struct MeasurementKind;
struct Observations;

/// What a case says is wrong with a source.
struct StatedErrors {
  const CorrectionCase* correction = nullptr;
  double time_shift = 0;
  std::vector<double> left_out;
};

/// The sources of one kind as a case names them: its section of `observations`.
class KindSection {
 public:
  explicit KindSection(const MeasurementKind& kind) : kind_(kind) {}
  virtual ~KindSection() = default;
  virtual void declare(Fields& f) = 0;
  virtual std::vector<std::string> names() const = 0;
  virtual std::unique_ptr<KindSection> copy() const = 0;
  /// Nothing of a kind without faults. Throws std::logic_error if there is no such source.
  virtual StatedErrors errors_of(const std::string& name) const = 0;
  const MeasurementKind& kind() const { return kind_; }

 private:
  const MeasurementKind& kind_;
};

/// How data may err beside their noise: each fault of the data (faults/) says what it needs to happen to.
struct Fallible {
  bool in_place = false;      ///< they show where the wall is: an image of it, displaced, turned, or off in one region
  bool in_threshold = false;  ///< they are drawn at an edge of an image: too far out, or blurred
  bool in_time = false;       ///< a time is stated for each frame
  bool in_value = false;      ///< they are read off an instrument, which may drift
};
namespace fallible {
inline constexpr Fallible image{.in_place = true, .in_threshold = true, .in_time = true}, instrument{.in_value = true};
}

/// A kind of measurement: declared beside its code in one file, listed once in registry.cpp.
struct MeasurementKind {
  std::string name;     ///< of its section in the case: "surfaces"
  std::string meaning;  ///< of that section
  std::string formats;  ///< of its files, for the manual
  Fallible fallible;
  /// Whether it is compared with the moving lumen, by observation_manager; else with what the run says of the blood.
  bool on_lumen;
  bool pulls_wall = false;  ///< whether it is distances, by which a state observer may pull the wall: a LumenSeries
  std::unique_ptr<KindSection> (*section)();
  /// Reads and checks what a section names. Throws InputError "file:line: ..." or that names the field.
  void (*load)(const KindSection& section, const CaseFile& file, FlowObservations& to) = nullptr;
  /// The same of a kind on the lumen, which takes a mesh. What reads it by VTK or measures it by CGAL has none here,
  /// but in lumen_kinds.cpp, so that fsi_master stays small.
  void (*load_on_lumen)(const KindSection& section, const LumenSurface& lumen, const CaseFile& file,
                        Observations& to) = nullptr;
};

/// Such a section, given what the case says of one source.
template <class Case>
class SectionOf : public KindSection {
 public:
  using KindSection::KindSection;
  void declare(Fields& f) override { f.groups(kind().name, sources, kind().meaning); }
  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (const auto& [name, source] : sources) all.push_back(name);
    return all;
  }
  std::unique_ptr<KindSection> copy() const override { return std::make_unique<SectionOf>(*this); }
  StatedErrors errors_of(const std::string& name) const override {
    for (const auto& [known, source] : sources)
      if (known == name) {
        if constexpr (requires(const Case& c) { c.stated_errors(); }) return source.stated_errors();
        return {};
      }
    throw std::logic_error(name + ": no such source");
  }
  Named<Case> sources;
};

template <class Case, const MeasurementKind& kind>
std::unique_ptr<KindSection> section_of() {
  return std::make_unique<SectionOf<Case>>(kind);
}

/// Of a section that is one of such cases.
template <class Case>
const Named<Case>& sources_of(const KindSection& section) {
  return dynamic_cast<const SectionOf<Case>&>(section).sources;
}

}  // namespace tether
