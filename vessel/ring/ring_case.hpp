#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/fields.hpp"

namespace tether {

/// The lumen's surfaces over time: a table that names them.
struct FramesCase {
  std::filesystem::path file;
  std::string column = "file", time = "time", unit, label_array = "ModelFaceID";
  bool any_size = false;
  void declare(Fields& f);
};

/// Which opening's ring; neither: the largest.
struct WhichRingCase {
  int label = 0;             ///< 0: not said
  std::vector<double> near;  ///< three coordinates, or empty: not said
  void declare(Fields& f);
};

/// A point that goes with the ring, beside its axis: it tells the turn about the axis.
struct LandmarkCase {
  std::filesystem::path file;
  std::string time = "time", x = "x", y = "y", z = "z", unit;
  void declare(Fields& f);
};

/// What `tether track-ring` reads. In cgs units.
struct RingTrackCase {
  std::string name;
  FramesCase frames;
  WhichRingCase ring;
  std::optional<LandmarkCase> landmark;
  void declare(Fields& f);
};

/// Throws InputError with a line for each mistake.
RingTrackCase read_ring_case(const std::filesystem::path& file);

/// The reference of the file: "text" or "markdown".
std::string ring_reference(const std::string& format);

}  // namespace tether
