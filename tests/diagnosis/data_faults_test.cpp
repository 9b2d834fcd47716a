// Every fault of the data, because it is registered.
#include "observation_manager/measurements/faults/faults.hpp"

#include <gtest/gtest.h>

#include <set>

#include "common/config/case_file.hpp"
#include "diagnosis/evidence/data_errors.hpp"
#include "tests/observation_manager/measured_samples.hpp"

namespace tether::testing {
namespace data_faults_test {

TEST(FaultDeclarations, SayWhatIsLookedForInWhichData) {
  std::set<std::string> names;
  for (const auto& fault : Faults()) {
    const FaultDeclaration& said = fault->declaration();
    ASSERT_NE(said.concerns, nullptr);
    EXPECT_TRUE(said.concerns(fallible::image) || said.concerns(fallible::instrument));
    EXPECT_FALSE(said.concerns({})) << "velocities have no faults";
    for (const FaultName& name : {said.of_all, said.of_frame}) {
      EXPECT_EQ(name.name.empty(), name.meaning.empty());
      if (name.name.empty()) continue;
      EXPECT_TRUE(names.insert(name.name).second) << name.name << " twice";
    }
    EXPECT_EQ(&fault->copy()->declaration(), &said);
  }
}

/// So fine that distances change by the normals, whichever triangle is closest; the vessel goes on behind its ends.
std::string write_fine_surfaces(const TemporaryFolder& folder, const SimpleRun& run) {
  std::string list = "file, time [s]\n";
  for (const double time : sample_times) {
    TriangleSurface measured = tube(64, 20, 5, [&](double) { return run.radius(time); });
    measured.points.row(2).array() -= 0.5;
    folder.file(fmt::format("s{}.stl", time), stl_text(measured));
    list += fmt::format("s{}.stl, {}\n", time, time);
  }
  folder.file("surfaces.csv", list);
  return "{file: surfaces.csv, unit: cm";
}

/// Surfaces and a pressure of another run than the one that they are held against.
class DataFaults : public ::testing::Test {
 protected:
  DataFaults() {
    const SimpleRun measured{1};
    folder.file("case.yaml",
                fmt::format("name: tube\nunits: cgs\ntime: {{step: 1e-2, end: 0.8}}\nobservations:\n"
                            "  surfaces: {{data: {}, noise: {{deviation: 0.04, correlation_length: 0.5}}}}}}\n"
                            "  traces: {{data: {}, noise: {{deviation: 50}}}}}}\n",
                            write_fine_surfaces(folder, measured), write_traces(folder, measured)));
  }
  Observations load(const std::string& name) const {
    CaseFile file(folder / name);
    ObservationsCase given;
    file.read("observations", given);
    file.finish();
    return load_observations(given, lumen, file);
  }
  VectorXd residual_of(const Observations& data) const { return Evidence(data, lumen, run).residuals({&run}).col(0); }

  TemporaryFolder folder;
  LumenSurface lumen = SimpleRun::imaged();
  FinishedMotion run = SimpleRun{}.finished();
};

/// What a quarter of the noise's deviation of it does is what its columns say, and gone once it is taken off.
TEST_F(DataFaults, AreGoneOnceTheyAreTakenOff) {
  const Observations data = load("case.yaml");
  const Evidence evidence(data, lumen, run);
  EffectProblem problem = evidence.problem();
  add_data_errors(problem, evidence, run, {}, UnitSystem::cgs(), {"value_offset", "value_scale", "value_lag"});
  const VectorXd deviation = (problem.independent.array() / problem.precision.array()).sqrt();
  int taken_off = 0;
  for (const Candidate& error : problem.candidates) {
    if (!std::isnan(error.data.frame)) continue;  // a frame is left out
    FoundFault found{{}, error.data.middle, 0};
    VectorXd expected = problem.residual;
    const MatrixXd columns = problem.changes(Eigen::all, error.amplitudes);
    const MatrixXd in_deviations = (problem.independent.array() > 0)
                                       .replicate(1, columns.cols())
                                       .select(columns.array().abs().colwise() / deviation.array(), 0);
    const double size = 0.25 / in_deviations.maxCoeff();
    for (const Eigen::Index k : error.amplitudes)
      found.numbers[problem.amplitudes[static_cast<std::size_t>(k)].name] = size;
    expected -= size * columns.rowwise().sum();
    Overlay corrected{folder / "case.yaml", "corrected", "", {}};
    for (const auto& [field, text] : Faults().take_off(error.name, found))
      corrected.values.push_back({error.data.field + "." + field, text});
    if (corrected.values.empty()) continue;  // nothing takes a blur off
    ++taken_off;
    write_overlay(folder / "corrected.yaml", corrected);
    const VectorXd after = residual_of(load("corrected.yaml"));
    double off = 0, all = 0;
    for (Eigen::Index i = 0; i < after.size(); ++i)
      if (problem.independent(i) > 0 && std::isfinite(after(i)))
        off += std::pow(after(i) - expected(i), 2), all += std::pow(problem.residual(i) - expected(i), 2);
    EXPECT_GT(all, 0) << error.name;
    EXPECT_LT(off, 0.02 * all) << error.name;
  }
  EXPECT_EQ(taken_off, 7);
}

}  // namespace data_faults_test
}  // namespace tether::testing
