#pragma once

#include "common/config/case_file.hpp"
#include "observation_manager/measurements/lumen_series.hpp"
#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// Where a source stands in the case.
struct LumenSource {
  const CaseFile& file;
  std::string field;  ///< "observations.surfaces.ct"
  std::string where(const std::string& part) const { return file.where(field + "." + part); }
};

SourceSettings settings_of(const LumenDataCase& data, double period, const LumenSurface& lumen,
                           const LumenSource& source);

bool holds(const std::vector<double>& numbers, double number);

/// What the case takes off the data.
void note_corrections(std::vector<Note>& notes, const LumenDataCase& data, const CaseFile& file);

/// A series that does not repeat must have something to say during the run. Throws InputError.
void check_range(double first, double last, double period, const LumenSource& source);

/// How far data may be from the model and still be of the same vessel: as far as they are trusted, or its radius.
double reach_of(const LumenDataCase& data, const LumenSurface& lumen);

/// Of the places that data face, half must lie within reach, in one frame at least.
inline constexpr double least_share = 0.5;

std::string share_text(double share, double reach);

}  // namespace tether
