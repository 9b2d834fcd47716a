#pragma once

#include "diagnosis/results/packed_floats.hpp"

/// The lumen of a compared run and its distance to the measurements, node by node: wall.json (docs/comparison.md).
namespace tether {

struct WallMomentTold {
  static constexpr const char* type_name = "wall_moment";
  double time = 0;
  bool held_out = false;
  PackedFloats positions, distances;
  std::vector<PackedFloats> lines;

  static void fields(auto& self, auto&& field) {
    field("time", self.time, "in the run [s]");
    field("held_out", self.held_out, "not used to make the model");
    field("positions", self.positions, "of the lumen's nodes in the run, 3 x nodes [length]");
    field("distances", self.distances, "1 x nodes, positive where the data lie outside; NaN: not measured [length]");
    field("lines", self.lines, "the measured contours, of surfaces some cuts, each 3 x points [length]");
  }
};

struct WallSourceTold {
  static constexpr const char* type_name = "wall_source";
  std::string name;
  bool contours = false;
  std::vector<WallMomentTold> moments;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("contours", self.contours, "else surfaces");
    field("moments", self.moments, "in the order of the run's times");
  }
};

struct ComparedWall {
  static constexpr const char* type_name = "compared_wall";
  static constexpr std::uintmax_t largest_file = 250'000'000;  ///< 20 moments of a million triangles
  std::string units;
  std::vector<int> triangles;
  std::vector<std::string> regions;
  std::vector<int> region;
  std::vector<WallSourceTold> sources;

  static void fields(auto& self, auto&& field) {
    field("units", self.units, "system of the case");
    field("triangles", self.triangles, "nodes of each, one triangle after the other");
    field("regions", self.regions, "of the wall");
    field("region", self.region, "of each node, a number of `regions`; -1: none");
    field("sources", self.sources, "of measurements of the lumen");
  }
};

}  // namespace tether
