#pragma once

#include <string>
#include <vector>

#include "diagnosis/comparison/registration.hpp"
#include "diagnosis/comparison/run_motion.hpp"
#include "diagnosis/comparison/statistics.hpp"
#include "observation_manager/measurements/error_regions.hpp"

namespace tether {

/// The samples of one region of the wall and one contour, or of all of them.
struct Group {
  int series = -1;             ///< number of the contour within its source; -1: all, and for surfaces
  int region = -1;             ///< number of the error region; -1: all
  Statistics model, apparent;  ///< of the run's lumen; of the imaged lumen, which shows the data's own motion
  double effective = 0;        ///< number of independent observations (D.2)
};

/// Frames of a source at the same time: one surface, or one contour of each slice.
struct Moment {
  double time = 0, data_time = 0;  ///< in the run; as the data have it [time]
  bool held_out = false;
  std::vector<Frame> frames;
  std::vector<Group> groups;
};

/// A source set against a run.
struct SourceDiscrepancy {
  std::string name, kind;
  int dimension = 2;  ///< 2: surfaces, statistics over areas; 1: contours, over lengths
  Noise noise;
  std::vector<std::string> series, regions;  ///< error regions
  std::vector<Moment> moments;               ///< in the order of the run's times
  std::vector<Group> training,
      held_out;                    ///< over all moments of the kind; an effective number with a correlation time only
  std::vector<std::string> notes;  ///< what was found and done on loading the data
  std::vector<Frame> outside;      ///< that the run does not reach
  std::optional<Registration> registration;  ///< of the frame that is closest to the imaged lumen, against that lumen
  std::size_t frames() const;                ///< in and outside the run
};

/// Compares the lumen of a run with every frame of a source, held-out ones too.
SourceDiscrepancy compare(const LumenSeries& data, const ErrorRegions& regions, const RunMotion& run);

/// Of the region, all series together; null if it is not there.
const Group* group_of_region(const Moment& moment, int region);

/// "spine", or "wall" if the wall has no regions.
std::string region_name(const SourceDiscrepancy& source, int region);

/// How many standard deviations the mean signed distance is from zero (D.3). Needs a noise.
double significance(const Group& group, const Noise& noise);

}  // namespace tether
