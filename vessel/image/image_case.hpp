#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/fields.hpp"

namespace tether {

/// A box along the patient's axes.
struct CropCase {
  Vec3 low = Vec3::Constant(undefined), high = Vec3::Constant(undefined);
  void declare(Fields& f);
};

/// Grey values that are lumen.
struct ThresholdCase {
  std::optional<double> above, below;
  void declare(Fields& f);
  bool admits(double value) const { return !(above && value < *above) && !(below && value > *below); }
};

/// How a front grows from seeds to where the grey values change.
struct LevelSetCase {
  std::optional<double> edge;
  double curvature = 0.2;
  int iterations = 1000;
  void declare(Fields& f);
};

/// A ball that is not lumen.
struct StopCase {
  Vec3 point = Vec3::Constant(undefined);
  double radius = undefined;
  void declare(Fields& f);
};

/// The file of an image, and what of it is lumen.
struct LumenImageCase {
  std::filesystem::path file;
  std::string unit = "mm", space = "lps";
  std::optional<CropCase> crop;
  std::vector<std::string> labels;  ///< values, or names of segments
  std::optional<ThresholdCase> threshold;
  std::optional<LevelSetCase> level_set;
  Named<Vec3> seeds, neighbours;
  Named<StopCase> stops;
  std::optional<double> smoothing;
  bool any_size = false;
  void declare(Fields& f);

  std::map<std::string, std::string> lines;  ///< of the study, "study.yaml:4", of a field such as "image.threshold"
  /// "study.yaml:4: image.threshold.above", or the field alone where the study is no file.
  std::string at(std::string field) const;
};

}  // namespace tether
