#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tether {

struct FittedOutlet {
  static constexpr const char* type_name = "fitted_outlet";
  std::string name;
  double share = 0, flow_share = 0;
  std::optional<double> area;
  double proximal_resistance = 0, distal_resistance = 0, compliance = 0, initial_pressure = 0;
  double mean_flow = 0, least_flow = 0, most_flow = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "");
    field("share", self.share, "of the flow, as asked");
    field("flow_share", self.flow_share, "of the flow in the periodic state");
    field("area", self.area, "[cm2], where it was asked for");
    field("proximal_resistance", self.proximal_resistance, "[mmHg s/ml]");
    field("distal_resistance", self.distal_resistance, "[mmHg s/ml]");
    field("compliance", self.compliance, "[ml/mmHg]");
    field("initial_pressure", self.initial_pressure, "of the reservoir at the beginning, absolute [mmHg]");
    field("mean_flow", self.mean_flow, "[ml/s]");
    field("least_flow", self.least_flow, "[ml/s]");
    field("most_flow", self.most_flow, "[ml/s]");
  }
};

/// Of a beat, absolute.
struct BeatPressures {
  static constexpr const char* type_name = "beat_pressures";
  double mean = 0, systolic = 0, diastolic = 0, pulse = 0;

  static void fields(auto& self, auto&& field) {
    field("mean", self.mean, "[mmHg]");
    field("systolic", self.systolic, "[mmHg]");
    field("diastolic", self.diastolic, "[mmHg]");
    field("pulse", self.pulse, "[mmHg]");
  }
};

/// outlets.json: Windkessels that make a pressure of a flow.
struct FittedOutlets {
  static constexpr const char* type_name = "fitted_outlets";
  std::string name, flow_from;
  double period = 0, start = 0, mean_flow = 0, venous_pressure = 0;
  std::optional<double> target_mean, target_pulse, misfit;
  std::optional<BeatPressures> measured;
  BeatPressures reached;
  double least_pulse = 0, most_pulse = 0, initial_inlet_pressure = 0;
  double resistance = 0, compliance = 0, vessel_compliance = 0, proximal_share = 0;
  std::vector<FittedOutlet> outlets;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "");
    field("flow_from", self.flow_from, "the table of the flow");
    field("period", self.period, "[s]");
    field("start", self.start, "the time of the flow's curve at which a run begins [s]");
    field("mean_flow", self.mean_flow, "into all outlets [ml/s]");
    field("venous_pressure", self.venous_pressure, "[mmHg]");
    field("target_mean", self.target_mean, "[mmHg]");
    field("target_pulse", self.target_pulse, "[mmHg]");
    field("measured", self.measured, "the pressure curve that was given");
    field("misfit", self.misfit, "to that curve, root mean square [mmHg]");
    field("reached", self.reached, "in the periodic state, where the outlets are joined");
    field("least_pulse", self.least_pulse, "what an infinite compliance would leave of the pulse pressure [mmHg]");
    field("most_pulse", self.most_pulse, "the pulse pressure without any compliance [mmHg]");
    field("initial_inlet_pressure", self.initial_inlet_pressure, "at the beginning, absolute [mmHg]");
    field("resistance", self.resistance, "of all outlets [mmHg s/ml]");
    field("compliance", self.compliance, "of all outlets [ml/mmHg]");
    field("vessel_compliance", self.vessel_compliance, "of the vessel itself, as it was given [ml/mmHg]");
    field("proximal_share", self.proximal_share, "of all outlets: proximal over whole resistance, joined");
    field("outlets", self.outlets, "");
  }
};

}  // namespace tether
