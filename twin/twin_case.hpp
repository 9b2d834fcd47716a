#pragma once

#include "common/config/fields.hpp"
#include "diagnosis/results/verdict.hpp"
#include "observation_manager/measurements/observation_case.hpp"

/// The section `twin` of a case: which run the data are made from, and what is done to them.
namespace tether {

/// How the lumen is imaged and segmented.
struct TwinImageCase {
  std::vector<double> voxel;  ///< size; a zero: no voxels [length]; set by the owner where the file is silent
  std::optional<double> blur;
  bool mask = true;
  int smoothing = 30;
  void declare(Fields& f);
};

/// What is wrong with an instrument.
struct InstrumentFaultsCase {
  Faults faults{fallible::instrument};
  Dimension dimension;  ///< of the values; set by the owner
  void declare(Fields& f) { faults.declare(f, dimension); }
};

/// A measured trace to make.
struct TwinTraceCase {
  std::string observable, quantity;
  double interval = undefined;
  InstrumentFaultsCase faults;
  NoiseCase noise;
  void declare(Fields& f);
};

/// An effect that the truth has and the model lacks.
struct HiddenEffectCase {
  std::string effect, where, unit;
  double amplitude = undefined;
  void declare(Fields& f);
};

/// The answer.
struct HiddenCase {
  Verdict verdict = Verdict::missing;
  Named<HiddenEffectCase> effects;
  void declare(Fields& f);
};

struct TwinCase {
  std::filesystem::path truth;
  int seed = 1, frames = 10;
  std::optional<double> beat, first;
  bool periodic = false;
  std::vector<double> held_out;
  TwinImageCase image;
  NoiseCase noise;
  Faults faults{fallible::image};
  Named<TwinTraceCase> traces;
  HiddenCase hidden;
  void declare(Fields& f);
};

}  // namespace tether
