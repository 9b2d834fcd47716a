#pragma once

#include <span>

#include "common/config/fields.hpp"

namespace tether {

/// The duration of a run and its steps.
struct TimeCase {
  double step = undefined, end = undefined, start = 0.0;
  void declare(Fields& f);
  /// Steps from start to end; the end is reached, or passed by less than a step.
  int steps() const;
};

/// The state in which the vessel was imaged: the run's reference.
struct ImageCase {
  double pressure = 0.0;
  std::string wall = "stress_free";
  void declare(Fields& f);
  /// Whether the wall bears the image's pressure at the start, and not only what exceeds it.
  bool loads_wall() const { return wall != "stress_free" && pressure != 0.0; }
};

/// The state observer: how strongly the wall is pulled toward the measured lumen.
struct ObserverCase {
  struct Region {
    double gain = 0;
    void declare(Fields& f);
  };
  double gain = 0;
  std::string form = "split";
  Named<Region> regions;
  void declare(Fields& f);
  double largest_gain() const;  ///< of any region
  bool is_on() const { return largest_gain() > 0; }
};

/// What a run writes, beside the tables that it always writes.
struct OutputCase {
  int write_every = 10, checkpoint_every = 50;
  Named<Vec3> points;
  void declare(Fields& f);
};

/// What every program reads of a case: the sections that belong to none of them.
struct CommonCase {
  std::string name, title, units;
  TimeCase time;
  ImageCase image;
  ObserverCase observer;
  OutputCase output;
  void declare(Fields& f);
  /// The title of a case that builds on this one, by `addition` as ", with corrected data"; of a case without a title
  /// the name begins it.
  std::string titled(const std::string& addition) const { return (title.empty() ? name : title) + addition; }
};

/// The top level of a case file: each section and the program that reads it. Others skip it, all know its name.
struct TopLevelSection {
  std::string_view name, meaning;
};
std::span<const TopLevelSection> top_level_sections();
std::string_view meaning_of_section(std::string_view name);

}  // namespace tether
