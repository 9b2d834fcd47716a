#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tether {

/// One term of the law of a force. Its sign is that of a traction along the outward normal.
struct LawTerm {
  static constexpr const char* type_name = "law_term";
  std::string name;
  double coefficient = 0, deviation = 0;
  std::vector<std::string> alike = {};

  static void fields(auto& self, auto&& field) {
    field("term", self.name, "as a formula of a case has it: un, vn, un*abs(un)");
    field("coefficient", self.coefficient, "[pressure over the term]");
    field("deviation", self.deviation, "of the coefficient");
    field("alike", self.alike, "terms that would do as well in its place");
  }
};

/// The law that a force of unknown origin may follow. (D.14)
struct ForceLaw {
  static constexpr const char* type_name = "force_law";
  std::vector<LawTerm> terms;
  double explained = 0;
  bool is_expression = true;
  std::string text = {};

  static void fields(auto& self, auto&& field) {
    field("text", self.text, "the formula");
    field("terms", self.terms, "in the order in which they were taken in; none: nothing explains the force");
    field("r2", self.explained, "share of the force's square that they explain");
    field("is_expression", self.is_expression, "all can stand in a case's formula: neither pressure nor acceleration");
  }
};

/// The traction that a region's wall misses, over time.
struct RegionForce {
  static constexpr const char* type_name = "region_force";
  std::string region, parameter, unit;
  std::vector<double> time, value, lower, upper;
  ForceLaw law;

  static void fields(auto& self, auto&& field) {
    field("region", self.region, "of the wall; empty: all of it");
    field("parameter", self.parameter, "by which it was identified");
    field("unit", self.unit, "of the values");
    field("time", self.time, "[s]");
    field("value", self.value, "along the outward normal");
    field("lower", self.lower, "of its 95 % interval");
    field("upper", self.upper, "of its 95 % interval");
    field("law", self.law, "that it may follow");
  }
};

/// The force that no candidate explains: force/force.json (docs/explain.md).
struct ForceFound {
  static constexpr const char* type_name = "missing_force";
  std::vector<RegionForce> regions;
  std::vector<std::string> sentences;
  std::optional<std::string> suggested_case;

  static void fields(auto& self, auto&& field) {
    field("regions", self.regions, "each with its traction");
    field("sentences", self.sentences, "one for each region");
    field("suggested_case", self.suggested_case,
          "file beside this one: the case with the laws that a formula can state");
  }
};

}  // namespace tether
