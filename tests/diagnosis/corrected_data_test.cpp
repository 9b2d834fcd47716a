#include "diagnosis/search/corrected_data.hpp"

#include <gtest/gtest.h>

#include <map>

#include "common/config/case_file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

/// What the case says of the data already stays.
TEST(CorrectedData, AreWhatTheDiagnosisAsksFor) {
  const TemporaryFolder folder;
  folder.file("ct.stl", "");
  CaseFile file(folder.file("case.yaml",
                            "name: tube\nunits: cgs\ntime: {step: 1e-2, end: 1}\nobservations: {surfaces: {ct: {file: "
                            "ct.stl, unit: cm, time_shift: 0.01, left_out: [1], correction: {displacement: [0.5, 0, "
                            "0]}}}}\n"));
  ObservationsCase observations;
  file.read("observations", observations);
  file.finish();
  DiagnosisReport report;
  const auto accept = [&](const std::string& name, const std::vector<std::string>& axes, const VectorXd& amplitudes,
                          double frame = undefined) {
    Candidate error{name, "ct", "", Candidate::Kind::data, {}};
    error.data = {"observations.surfaces.ct", frame, Vec3(1, 2, 3)};
    for (const std::string& axis : axes) {
      error.amplitudes.push_back(static_cast<Eigen::Index>(report.problem.amplitudes.size()));
      report.problem.amplitudes.push_back({axis, "", "cm"});
    }
    TestedEffect effect;
    effect.candidate = report.problem.candidates.size();
    effect.amplitudes = amplitudes;
    effect.accepted = true;
    report.problem.candidates.push_back(error);
    report.found.effects.push_back(effect);
  };
  accept("misregistration", {"x", "y", "z"}, Vec3(0.25, -0.5, 0));
  accept("misrotation", {"about_x", "about_z"}, Eigen::Vector2d(0.125, 0.25));
  accept("segmentation_bias", {"bias"}, VectorXd::Constant(1, 0.0625));
  accept("gating_shift", {"time_shift"}, VectorXd::Constant(1, 0.03125));
  accept("misplaced_frame", {"x", "y", "z"}, Vec3(1, 0, 0), 4);
  accept("blur", {"variance"}, VectorXd::Constant(1, 0.1));
  std::map<std::string, std::string> said;
  for (const auto& [field, value] : corrections_of(report, observations))
    said[field.substr(std::string("observations.surfaces.ct.").size())] = value;
  EXPECT_EQ(said, (std::map<std::string, std::string>{{"correction.displacement", "[0.25, 0.5, 0]"},
                                                      {"correction.rotation", "[-0.125, 0, -0.25]"},
                                                      {"correction.about", "[0.5, 2, 3]"},
                                                      {"correction.outward", "-0.0625"},
                                                      {"time_shift", "0.04125"},
                                                      {"left_out", "[1, 4]"}}));
}

}  // namespace
}  // namespace tether
