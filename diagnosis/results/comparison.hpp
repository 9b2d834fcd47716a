#pragma once

#include "common/base/types.hpp"
#include "common/io/record.hpp"
#include "diagnosis/results/distances.hpp"

/// How a run compares with the measurements: comparison.json (docs/comparison.md).
namespace tether {

struct NoiseTold {
  static constexpr const char* type_name = "noise";
  double deviation = 0, correlation_length = 0, correlation_time = 0;

  static void fields(auto& self, auto&& field) {
    field("deviation", self.deviation, "standard deviation; 0: none is stated");
    field("correlation_length", self.correlation_length, "[length]");
    field("correlation_time", self.correlation_time, "[s]");
  }
};

struct FrameTold {
  static constexpr const char* type_name = "frame";
  std::string series;
  double label = 0;
  std::optional<double> time;

  static void fields(auto& self, auto&& field) {
    field("series", self.series, "the surfaces, or a contour");
    field("frame", self.label, "its number, as the case counts them");
    field("time", self.time, "[s]; null: it holds always");
  }
};

struct MomentTold {
  static constexpr const char* type_name = "moment";
  double time = 0;
  bool held_out = false;
  std::vector<FrameTold> frames;
  std::vector<GroupTold> groups;

  static void fields(auto& self, auto&& field) {
    field("time", self.time, "in the run [s]");
    field("held_out", self.held_out, "not used to make the model");
    field("frames", self.frames, "at that time");
    field("groups", self.groups, "all together, and by region and contour");
  }
};

/// Consecutive moments of a region in which the model is farther off than noise explains.
struct FailureTold {
  static constexpr const char* type_name = "failure";
  std::string region;
  double first = 0, last = 0, worst = 0;
  bool shifted = false;
  double mean = 0, rms = 0, z = 0;
  std::string sentence;

  static void fields(auto& self, auto&& field) {
    field("region", self.region, "of the wall");
    field("first", self.first, "moment [s]");
    field("last", self.last, "moment [s]");
    field("worst", self.worst, "moment [s]");
    field("shifted", self.shifted, "the mean signed distance is beyond noise; else the mean square only");
    field("mean", self.mean, "at the worst moment [length]");
    field("l2", self.rms, "at the worst moment [length]");
    field("z", self.z, "significance of that mean (D.3)");
    field("sentence", self.sentence, "the same in words");
  }
};

struct JudgementTold {
  static constexpr const char* type_name = "judgement";
  int tests = 0;
  double limit = 0;
  std::vector<FailureTold> failures;
  std::map<std::string, double> visible_offset;

  static void fields(auto& self, auto&& field) {
    field("tests", self.tests, "regions times moments that were looked at; 0: no noise is stated");
    field("limit", self.limit, "of |z|, so that of 20 right models 19 pass in all tests (D.4)");
    field("failures", self.failures, "in the order of their first moments");
    field("visible_offset", self.visible_offset, "by region, what one frame would show [length] (D.5)");
  }
};

struct FramesJudged {
  static constexpr const char* type_name = "frames_judged";
  JudgementTold judgement;
  std::vector<GroupTold> all_frames;

  static void fields(auto& self, auto&& field) {
    field("verdict", self.judgement, "whether they are within noise of the run");
    field("all_frames", self.all_frames, "statistics over all of them");
  }
};

struct RegistrationTold {
  static constexpr const char* type_name = "registration";
  Vec3 displacement{0, 0, 0}, rotation{0, 0, 0}, centre{0, 0, 0};
  double before = 0, after = 0;
  bool stands_out = false;

  static void fields(auto& self, auto&& field) {
    field("displacement", self.displacement, "that brings the data back [length]");
    field("rotation", self.rotation, "vector, about the centre [radian]");
    field("centre", self.centre, "[length]");
    field("before", self.before, "root mean square distance [length]");
    field("after", self.after, "the same of the data moved back [length]");
    field("stands_out", self.stands_out, "it is to be looked at before any physics");
  }
};

struct SourceCompared {
  static constexpr const char* type_name = "source";
  std::string name, kind;
  std::vector<std::string> series, regions;
  NoiseTold noise;
  std::vector<std::string> notes;
  std::optional<RegistrationTold> registration;
  int frames = 0;
  std::vector<FrameTold> frames_outside_the_run;
  FramesJudged training, held_out;
  std::vector<MomentTold> moments;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("kind", self.kind, "of the measurement: surfaces, contours");
    field("series", self.series, "the surfaces, or contours");
    field("regions", self.regions, "of the wall");
    field("noise", self.noise, "of distances [length]");
    field("notes", self.notes, "what was found and done on loading the data");
    field("registration", self.registration, "of the frame closest to the imaged lumen, against that lumen");
    field("frames", self.frames, "in and outside the run");
    field("frames_outside_the_run", self.frames_outside_the_run, "that are not compared");
    field("training", self.training, "frames that made the model");
    field("held_out", self.held_out, "frames that did not");
    field("moments", self.moments, "in the order of the run's times");
  }
};

struct TraceInNoise {
  static constexpr const char* type_name = "trace_in_noise";
  double rms = 0, largest = 0, bias = 0;

  static void fields(auto& self, auto&& field) {
    field("l2", self.rms, "root mean square");
    field("linf", self.largest, "the largest");
    field("bias", self.bias, "mean of measured minus model");
  }
};

/// A measured pressure or flow beside the run's.
struct TraceCompared {
  static constexpr const char* type_name = "trace";
  std::string name, observable, unit;
  bool held_out = false;
  int values = 0, values_outside_the_run = 0;
  std::optional<double> rms, largest, bias, effective_observations;
  std::optional<TraceInNoise> in_noise;
  std::optional<double> z;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("observable", self.observable, "column of the run's table");
    field("unit", self.unit, "of the values");
    field("held_out", self.held_out, "not used to make the model");
    field("values", self.values, "that were compared");
    field("values_outside_the_run", self.values_outside_the_run, "that were not");
    field("l2", self.rms, "root mean square of the difference");
    field("linf", self.largest, "the largest difference");
    field("bias", self.bias, "mean of measured minus model");
    field("effective_observations", self.effective_observations, "number of independent ones (D.2)");
    field("in_noise", self.in_noise, "the same in the noise's deviation");
    field("z", self.z, "significance of the bias (D.3)");
  }
};

struct VelocityInNoise {
  static constexpr const char* type_name = "velocity_in_noise";
  double rms = 0, largest = 0;

  static void fields(auto& self, auto&& field) {
    field("l2", self.rms, "root mean square");
    field("linf", self.largest, "the largest");
  }
};

struct VelocityStatisticsTold {
  static constexpr const char* type_name = "velocity_statistics";
  int points = 0;
  std::optional<double> rms, largest, measured, bias;
  std::optional<VelocityInNoise> in_noise;

  static void fields(auto& self, auto&& field) {
    field("points", self.points, "with a measured and a simulated velocity");
    field("l2", self.rms, "root mean square of the difference of a component");
    field("linf", self.largest, "the largest difference");
    field("l2_measured", self.measured, "root mean square of the measured components");
    field("bias", self.bias, "of one component: mean of measured minus model");
    field("in_noise", self.in_noise, "the same in the noise's deviation");
  }
};

struct VelocityMomentTold : VelocityStatisticsTold {
  static constexpr const char* type_name = "velocity_moment";
  double time = 0, data_time = 0;
  bool held_out = false;
  int points_outside_the_lumen = 0;
  double effective_points = 0;
  std::optional<double> z;

  static void fields(auto& self, auto&& field) {
    field("time", self.time, "in the run [s]");
    field("data_time", self.data_time, "as the data have it [s]");
    field("held_out", self.held_out, "not used to make the model");
    VelocityStatisticsTold::fields(self, field);
    field("points_outside_the_lumen", self.points_outside_the_lumen, "of the run");
    field("effective_points", self.effective_points, "number of independent ones (D.6)");
    field("z", self.z, "significance of the bias");
  }
};

struct VelocityCompared {
  static constexpr const char* type_name = "velocity";
  std::string name, unit;
  int components = 3, points = 0, frames_outside_the_run = 0;
  VelocityStatisticsTold training, held_out;
  std::vector<VelocityMomentTold> moments;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("unit", self.unit, "of the values");
    field("components", self.components, "1: through a plane, 3: all");
    field("points", self.points, "of the measurement");
    field("frames_outside_the_run", self.frames_outside_the_run, "that are not compared");
    field("training", self.training, "frames that made the model");
    field("held_out", self.held_out, "frames that did not");
    field("moments", self.moments, "in the order of the run's times");
  }
};

struct OtherStatisticsTold {
  static constexpr const char* type_name = "other_statistics";
  int values = 0;
  std::optional<double> rms, largest, bias;
  std::optional<TraceInNoise> in_noise;

  static void fields(auto& self, auto&& field) {
    field("values", self.values, "that were compared");
    field("l2", self.rms, "root mean square of the difference");
    field("linf", self.largest, "the largest difference");
    field("bias", self.bias, "mean of measured minus model");
    field("in_noise", self.in_noise, "the same in the noise's deviation");
  }
};

/// A measurement of a kind without a form of its own.
struct OtherCompared {
  static constexpr const char* type_name = "other";
  std::string name, kind, unit;
  OtherStatisticsTold training, held_out;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "as the case calls it");
    field("kind", self.kind, "of the measurement");
    field("unit", self.unit, "of the values");
    field("training", self.training, "data that made the model");
    field("held_out", self.held_out, "data that did not");
  }
};

struct RunCompared {
  static constexpr const char* type_name = "compared_run";
  std::string folder;
  int steps = 0;
  double start = 0, end = 0, observer_gain = 0;
  bool is_evidence = true;

  static void fields(auto& self, auto&& field) {
    field("folder", self.folder, "of its results");
    field("steps", self.steps, "of the run");
    field("start", self.start, "[s]");
    field("end", self.end, "[s]");
    field("observer_gain", self.observer_gain, "above zero the run was pulled toward the data [1/s]");
    field("is_evidence", self.is_evidence, "it was not");
  }
};

struct ComparedUnits {
  static constexpr const char* type_name = "compared_units";
  std::string system, length, time;

  static void fields(auto& self, auto&& field) {
    field("system", self.system, "of the case");
    field("length", self.length, "of all distances");
    field("time", self.time, "of all times");
  }
};

struct ComparisonResult {
  static constexpr const char* type_name = "comparison";
  std::string case_name, title;
  RunCompared run;
  ComparedUnits units;
  std::vector<std::string> sentences, first_look;
  std::vector<SourceCompared> sources;
  std::vector<TraceCompared> traces;
  std::vector<VelocityCompared> velocities;
  std::vector<OtherCompared> others;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_name, "name of the case");
    field("title", self.title, "of the case");
    field("run", self.run, "that was compared");
    field("units", self.units, "of the case");
    field("sentences", self.sentences, "what a person should know");
    field("first_look", self.first_look,
          "of these, what to look at before any physics, and where the model fails worst");
    field("sources", self.sources, "surfaces and contours");
    field("traces", self.traces, "pressures and flows");
    field("velocities", self.velocities, "of the blood");
    field("others", self.others, "measurements of other kinds");
  }
};

}  // namespace tether
