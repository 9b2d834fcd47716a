#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tether {

/// Lengths, or the same in the noise's deviation. (D.1)
struct DistancesTold {
  static constexpr const char* type_name = "distances";
  double rms = 0, largest = 0, mean = 0, p95 = 0;

  static void fields(auto& self, auto&& field) {
    field("l2", self.rms, "root mean square");
    field("linf", self.largest, "the largest");
    field("mean", self.mean, "signed: positive where the data lie outside the model");
    field("p95", self.p95, "95 % of the extent are closer");
  }
};

/// What the signed distances of some samples amount to; null without samples.
struct StatisticsTold {
  static constexpr const char* type_name = "distance_statistics";
  int samples = 0;
  std::map<std::string, int> excluded;
  double extent = 0;
  std::optional<double> rms, largest, mean, p95, unnormalised;
  std::optional<DistancesTold> in_noise;

  static void fields(auto& self, auto&& field) {
    field("samples", self.samples, "places with a distance");
    field("excluded", self.excluded, "places without one, by reason");
    field("extent", self.extent, "what the samples stand for: area [length^2] or length [length]");
    field("l2", self.rms, "root mean square [length]");
    field("linf", self.largest, "the largest [length]");
    field("mean", self.mean, "signed: positive where the data lie outside the model [length]");
    field("p95", self.p95, "95 % of the extent are closer [length]");
    field("l2_unnormalised", self.unnormalised, "root of the integral of the square");
    field("in_noise", self.in_noise, "the same in the noise's deviation, where a noise is stated");
  }
};

/// A region of the wall and one contour, or all of them.
struct GroupTold : StatisticsTold {
  static constexpr const char* type_name = "distance_group";
  std::optional<std::string> series, region;
  std::optional<double> effective_observations, z;
  StatisticsTold apparent;

  static void fields(auto& self, auto&& field) {
    field("series", self.series, "a contour; null: all together");
    field("region", self.region, "of the wall; null: all of it");
    StatisticsTold::fields(self, field);
    field("effective_observations", self.effective_observations, "number of independent ones (D.2)");
    field("z", self.z, "significance of the mean (D.3)");
    field("apparent", self.apparent, "of the imaged lumen in the place of the run's: the data's own motion");
  }
};

}  // namespace tether
