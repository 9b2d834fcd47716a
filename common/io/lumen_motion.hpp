#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The lumen's motion over a run, lumen.motion: after a line of text, the number of nodes and their imaged positions
/// (int64, doubles), then for each step its time (double) and the displacements (floats: to 1e-7 of themselves), x y z
/// of node after node, little-endian.
class LumenMotionWriter {
 public:
  LumenMotionWriter(std::filesystem::path path, Points imaged);

  /// A new file.
  void start();
  /// Goes on behind the first `records` records of the file; later ones are dropped. Throws InputError if the file is
  /// of another lumen or has fewer.
  void resume(std::int64_t records);
  /// On the disk when this returns. Throws RunError if it cannot be written.
  void append(double time, const Points& displacement);

 private:
  std::filesystem::path path_;
  Points imaged_;
  std::ofstream file_;
};

/// Such a motion, read back.
class LumenMotion {
 public:
  /// Throws InputError for a file that is none.
  explicit LumenMotion(const std::filesystem::path& path);

  const Points& imaged() const { return imaged_; }
  const std::vector<double>& times() const { return times_; }
  /// Positions at a time, linear between steps. Throws InputError for a time outside the run.
  Points at(double time) const;

 private:
  Points displacement(std::size_t record) const;

  std::filesystem::path path_;
  Points imaged_;
  std::vector<double> times_;
  std::vector<float> displacements_;
};

}  // namespace tether
