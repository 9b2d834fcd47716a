#pragma once

#include "common/config/fields.hpp"
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

/// What goes wrong with data. Frames by their number from 0; -1: all of them.
struct TwinFaultsCase {
  struct Mistimed {
    int frame = -1;
    double shift = 0;
    void declare(Fields& f);
  };
  struct Misplaced {
    int frame = -1;
    Vec3 offset{undefined, undefined, undefined};
    void declare(Fields& f);
  };
  struct Cropped {
    int frame = -1;
    Vec3 point{undefined, undefined, undefined}, normal{undefined, undefined, undefined};
    void declare(Fields& f);
  };
  std::vector<double> lost;
  std::optional<Mistimed> mistimed;
  std::optional<Misplaced> misplaced;
  std::optional<Cropped> cropped;
  double bias = 0, clipped_ends = 0;
  void declare(Fields& f);
};

/// A measured trace to make.
struct TwinTraceCase {
  std::string observable, quantity;
  double interval = undefined;
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
  std::string verdict = "missing";
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
  TwinFaultsCase faults;
  Named<TwinTraceCase> traces;
  HiddenCase hidden;
  void declare(Fields& f);
};

}  // namespace tether
