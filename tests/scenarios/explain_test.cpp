/// `tether explain` with the real programs: a coarse configs/tube without the spine's support, against data with it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/processes.hpp"
#include "tests/scenarios/valid_results.hpp"

namespace tether {
namespace explain_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* model = R"(base: {}/configs/tube/case.yaml
name: model
time: {{step: 4e-3, end: 0.12}}
mesh: {{swept: {{around: 12, along: 8}}}}
solid: {{support: {{regions: {{spine: {{stiffness: 0}}}}}}}}
diagnosis:
  candidates: [{}]
  exclude: [vicinity_left, vicinity_right, opposite, fluid.density, solid.density, fluid.rheology.viscosity]
  numerics: false
twin:
  truth: held.yaml
  frames: 8
  image: {{voxel: [0, 0, 0]}}
  noise: {{deviation: 0.03 mm, correlation_length: 5 mm}}
  held_out: [3, 6]
  hidden: {{effects: {{visco_elastic: {{where: spine, amplitude: 4e5, unit: g/(cm2 s2)}}}}}}
)";

/// Both tests look at the same twin.
class Explain : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder);
    write("held.yaml",
          "base: model.yaml\nname: held\ntwin: ~\nsolid: {support: {regions: {spine: {stiffness: 4e5}}}}\n");
    write("model.yaml", fmt::format(model, TETHER_SOURCE, "tissue_mass"));
    const ChildEnd made = tether({"twin", (folder / "model.yaml").string(), "--output", (folder / "twin").string()});
    ASSERT_EQ(made.exit_code, 0) << made.errors;
  }
  static void TearDownTestSuite() {
    expect_valid_results(folder);
    fs::remove_all(folder);
  }
  static void write(const std::string& name, const std::string& content) { std::ofstream(folder / name) << content; }
  static ChildEnd tether(const std::vector<std::string>& words) {
    std::vector<std::string> line{TETHER_PROGRAM};
    line.insert(line.end(), words.begin(), words.end());
    return capture({line, {}});
  }
  Json explained() {
    const ChildEnd end = tether({"explain", (folder / "twin/case.yaml").string(), "--output", output().string()});
    EXPECT_EQ(end.exit_code, 0) << end.errors << end.output;
    said = end.output;
    return Json::parse(content_of(output() / "explain.json"));
  }
  static fs::path output() { return folder / ::testing::UnitTest::GetInstance()->current_test_info()->name(); }

  static inline const fs::path folder = fs::temp_directory_path() / fmt::format("tether_explain_{}", getpid());
  std::string said;
};

TEST_F(Explain, AddsWhatIsMissingAndTheErrorFalls) {
  const Json found = explained();
  EXPECT_EQ(found["verdict"], "missing") << said;
  ASSERT_EQ(found["models"].size(), 2U) << said;
  const Json &first = found["models"][0], &last = found["models"][1];
  EXPECT_TRUE(last["accepted"]);
  EXPECT_LT(last["held_out"]["l2"], 0.5 * first["held_out"]["l2"].get<double>());
  EXPECT_LT(last["held_out"]["in_noise"], 1.2);
  EXPECT_GT(last["held_out_gain"]["lower"], 0);
  const Json& effect = found["effects"][0];
  EXPECT_EQ(effect["name"], "visco_elastic");
  EXPECT_EQ(effect["where"], "spine");
  EXPECT_LT(effect["amplitude"]["lower"], 4e5);
  EXPECT_GT(effect["amplitude"]["upper"], 4e5);
  EXPECT_NEAR(effect["amplitude"]["value"], 4e5, 0.1 * 4e5);
  EXPECT_NE(said.find("MISSING: visco_elastic stiffness at spine"), std::string::npos) << said;

  const fs::path suggested = output() / found["suggested_case"].get<std::string>();
  EXPECT_EQ(tether({"validate", suggested.string()}).exit_code, 0);
  const ChildEnd scored = tether({"score", (folder / "twin").string(), "--output", output().string()});
  EXPECT_NE(scored.output.find("verdict: missing: right"), std::string::npos) << scored.output << scored.errors;

  EXPECT_EQ(
      said_by_python(fmt::format("import tether, numpy\n"
                                 "found = tether.load('{}')\n"
                                 "d = found.distances('spine', 2)\n"
                                 "print(found.verdict, found.effects[0].name, len(found.models), found.file)\n"
                                 "print(d.ndim == 1 and d.size > 10 and bool(numpy.isfinite(d).any()))\n"
                                 "for wanted in [dict(region='x'), dict(frame=99), dict(source='x'), dict(model=7)]:\n"
                                 "    try: found.distances(**wanted)\n"
                                 "    except KeyError as error: print('there are: ' in str(error))\n"
                                 "print(len(found.models[0].added), type(found.models[0].added).__name__)\n"
                                 "table = found.effects.frame()\n"
                                 "print(table['amplitude.value'][0] == found.effects[0].amplitude.value)\n"
                                 "print(found.wall().triangles.size % 3, found.wall().region.ndim)\n",
                                 output().string())),
      "missing visco_elastic 2 explain.json\nTrue\nTrue\nTrue\nTrue\nTrue\n0 Table\nTrue\n0 1\n");

  fs::remove(output() / "model_1/comparison.json");  // as if it had been interrupted there
  const auto identified = fs::last_write_time(output() / "identification_1/estimate.json");
  const Json again = explained();
  EXPECT_EQ(fs::last_write_time(output() / "identification_1/estimate.json"), identified) << "steps are kept";
  EXPECT_TRUE(fs::exists(output() / "model_1/comparison.json"));
  EXPECT_EQ(again["effects"], found["effects"]);
  EXPECT_EQ(again["sentences"], found["sentences"]);
  for (const auto& [file, verb] :
       {std::pair{output() / "identification_1/identified.yaml", "identify"}, std::pair{suggested, "explain"}}) {
    const std::string made = content_of(file);
    std::ofstream(file, std::ios::app) << "# mine\n";
    const ChildEnd refused = tether({"explain", (folder / "twin/case.yaml").string(), "--output", output().string()});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.errors, fmt::format("{}: is not as tether {} made it, and would be replaced; keep it elsewhere, "
                                          "or give --overwrite\n",
                                          file.string(), verb));
    EXPECT_EQ(content_of(file), made + "# mine\n");
    std::ofstream(file) << made;
  }
}

/// Broken off, the run of a model goes on from its checkpoint. It has steps for more than the half second that a
/// program still works after a signal (common/protocol/signals).
TEST_F(Explain, GoesOnFromTheCheckpointOfARun) {
  const fs::path file = folder / "twin/often.yaml";
  write("twin/often.yaml", "base: case.yaml\nname: often\ntime: {step: 2e-4}\noutput: {checkpoint_every: 20}\n");
  const auto broken_off_when = [&](const fs::path& is_there) {
    auto end = std::async(std::launch::async, [&] {
      return tether({"explain", file.string(), "--output", output().string(), "--quiet"});
    });
    while (!fs::exists(is_there) && end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) continue;
    const pid_t front_end = process_of("tether", file);
    EXPECT_NE(front_end, 0);
    if (front_end != 0) kill(front_end, SIGTERM);
    const ChildEnd ended = end.get();
    EXPECT_EQ(ended.exit_code, 1);
    return ended.errors;
  };
  const std::string told = broken_off_when(output() / "model_0/checkpoint/master.bin");
  EXPECT_NE(told.find("the same command goes on from here"), std::string::npos) << told;
  EXPECT_EQ(told.find("To continue"), std::string::npos) << "one way on: " << told;
  ASSERT_FALSE(fs::exists(output() / "model_0/summary.json"));
  broken_off_when(output() / "model_0/summary.json");
  EXPECT_GE(Json::parse(content_of(output() / "model_0/summary.json"))["resumed_at_step"], 20);
}

/// A misspelled number is one that only the programs know to be wrong.
TEST_F(Explain, RefusesAnUnknownNumberBeforeItsFirstRun) {
  write("twin/unknown.yaml", "base: case.yaml\nname: unknown\ndiagnosis: {candidates: [solid.material.yuong]}\n");
  const ChildEnd end = tether({"explain", (folder / "twin/unknown.yaml").string(), "--output", output().string()});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("solid.material.yuong"), std::string::npos) << end.errors;
  EXPECT_FALSE(fs::exists(output() / "model_0"));
}

/// Its run would be told as that of the model that explain made.
TEST_F(Explain, RefusesAModelThatIsChangedBeforeItsRunHasEnded) {
  const fs::path first = output() / "model_0.yaml";
  auto end = std::async(std::launch::async, [&] {
    return tether({"explain", (folder / "twin/case.yaml").string(), "--output", output().string(), "--quiet"});
  });
  while (!fs::exists(first) && end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) continue;
  const std::string made = content_of(first);
  std::ofstream(first, std::ios::app) << "# mine\n";
  const ChildEnd refused = end.get();
  const std::string by_the_run = fmt::format(
      "tether explain: {}: was written during the run, which may have read it before and after: start it "
      "again\n",
      first.string());
  const std::string after_it = fmt::format(
      "{}: is not as tether explain made it, and would be replaced; keep it elsewhere, or give --overwrite\n",
      first.string());
  const bool was_read = refused.errors == by_the_run;  // a busy machine: the run had begun to read it
  EXPECT_EQ(refused.errors, was_read ? by_the_run : after_it);
  EXPECT_EQ(refused.exit_code, was_read ? 1 : 2);
  EXPECT_EQ(content_of(first), made + "# mine\n");
  EXPECT_FALSE(fs::exists(output() / "explain.json"));
}

/// The catalogue is cut to what cannot explain the data: the force itself is sought, and holds the wall
/// back as the spine does.
TEST_F(Explain, SeeksTheForceThatNoCandidateExplains) {
  write("twin/other.yaml",
        "base: case.yaml\nname: other\ndiagnosis: {exclude: [spine, vicinity_left, vicinity_right, opposite, "
        "solid.support.regions.spine.stiffness, solid.support.regions.spine.damping, solid.material.young, "
        "solid.density, fluid.density, "
        "fluid.rheology.viscosity]}\n");
  const ChildEnd end = tether({"explain", (folder / "twin/other.yaml").string(), "--output", output().string()});
  ASSERT_EQ(end.exit_code, 0) << end.errors << end.output;
  const Json found = Json::parse(content_of(output() / "explain.json"));
  EXPECT_EQ(found["verdict"], "not_in_catalogue") << end.output;
  ASSERT_EQ(found["missing_force"], "force/force.json");
  const Json force = Json::parse(content_of(output() / "force/force.json"));
  ASSERT_EQ(force["regions"].size(), 4U);
  const Json& spine = force["regions"][0];
  EXPECT_EQ(spine["region"], "spine");
  ASSERT_EQ(spine["time"].size(), spine["value"].size());
  ASSERT_GT(spine["value"].size(), 10U);
  double largest = 0;
  for (const Json& value : spine["value"])
    if (std::abs(value.get<double>()) > std::abs(largest)) largest = value;
  EXPECT_LT(largest, 0) << "the wall moves outward, the spine that is missing holds it back: " << spine;
  const Json comparison = Json::parse(content_of(output() / "force/run/comparison.json"));
  EXPECT_TRUE(comparison.contains("sources"));
}

}  // namespace explain_test
}  // namespace tether
