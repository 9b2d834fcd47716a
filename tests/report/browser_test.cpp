/// `tether report` with the real programs: a coarse tube before and after a change, against surfaces of the changed
/// one, and the page in a browser without a screen.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "identification_master/results/estimate.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/surface_file.hpp"

namespace tether {
namespace browser_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

ChildEnd tether(const std::vector<std::string>& words) {
  std::vector<std::string> line{TETHER_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  return capture({line, {}});
}

/// A browser without a screen need not draw a frame, and on a busy machine draws none in time: what waits for the next
/// one gets its turn from the clock that the browser is run by.
constexpr const char* frames_by_the_clock = R"js(<script>
window.requestAnimationFrame = (act) => setTimeout(() => act(performance.now()), 16);
</script>)js";

/// Notes every field that the page's scripts ask of the report and that no result has: writers write all fields of
/// their schemas, what does not exist as null. Objects by a unit's symbol have none for other units.
constexpr const char* note_unknown_fields = R"js(<script>
const unknownFields = new Set(), watchedObjects = new WeakMap(), parse = JSON.parse;
function watched(value, path) {
  if (value === null || typeof value !== "object") return value;
  if (!watchedObjects.has(value)) watchedObjects.set(value, new Proxy(value, { get(target, key) {
    if (typeof key === "string" && !Array.isArray(target) && !(key in target) && key !== "toJSON" && !path.endsWith(".clinical")) unknownFields.add(`${path}.${key}`);
    return watched(target[key], Array.isArray(target) ? path : `${path}.${String(key)}`);
  } }));
  return watchedObjects.get(value);
}
JSON.parse = (text, ...more) => watched(parse(text, ...more), "report");
</script>)js";

/// What a script finds out about a page that it is added to: it leaves a value in `found`.
Json found_in(const fs::path& page, const std::string& script) {
  std::string text = content_of(page);
  text.insert(text.find("<head>") + 6, std::string(frames_by_the_clock) + note_unknown_fields);
  const std::string end = "</body>";
  text.insert(text.rfind(end),
              "<script>addEventListener('load', () => setTimeout(() => { let found = {}; " + script +
                  " found.unknown = [...unknownFields]; const out = document.createElement('pre'); out.id = 'found'; "
                  "out.textContent = "
                  "JSON.stringify(found).replace(/[<>&]/g, (c) => '\\\\u00' + "
                  "c.charCodeAt(0).toString(16)); document.body.append(out); }, 200));</script>");
  const fs::path copy = page.parent_path() / "looked_at.html";
  std::ofstream(copy) << text;
  const std::string open = "<pre id=\"found\">";
  ChildEnd browser;
  for (int tries = 0; tries < 3 && browser.output.find(open) == std::string::npos;
       ++tries)  // it gives up if it is busy
    browser = capture({{"chromium-headless-shell", "--no-sandbox", "--disable-gpu", "--use-gl=angle",
                        "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=900,1200",
                        "--virtual-time-budget=30000", "--dump-dom", "file://" + copy.string()},
                       {}});
  const auto at = browser.output.find(open);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the script did not run (is chromium-headless-shell installed?)\n" << browser.errors;
    return {};
  }
  const auto first = at + open.size();
  Json found = Json::parse(browser.output.substr(first, browser.output.find("</pre>", first) - first));
  EXPECT_EQ(found["unknown"], Json::array()) << "fields that no result has";
  return found;
}

constexpr const char* model = R"(base: {}/configs/tube/case.yaml
name: model_0
time: {{step: 4e-3, end: 0.112}}
mesh: {{swept: {{around: 12, along: 8}}}}
solid: {{support: {{regions: {{spine: {{stiffness: 0}}}}}}}}
)";

/// Two models of a beat's first part; the second is held by the spine, and what was measured is its lumen.
class ReportPage : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder);
    write("model_0.yaml", fmt::format(model, TETHER_SOURCE));
    write("model_1.yaml",
          "base: model_0.yaml\nname: model_1\nsolid: {support: {regions: {spine: {stiffness: 1e6}}}}\n");
    run("simulate", "model_1");
    const LumenMotion truth(folder / "model_1/lumen.motion");
    const auto triangles = ObservedCase(folder / "model_0.yaml").lumen().triangles;
    std::string list = "file, time [s]\n";
    for (const int k : {12, 20, 28}) {
      const std::string name = fmt::format("frame_{}.stl", k);
      write_stl(folder / name, truth.at(step * k), triangles);
      list += fmt::format("{}, {}\n", name, step * k);
    }
    write("frames.csv", list);
    std::ofstream(folder / "model_0.yaml", std::ios::app)
        << "observations: {surfaces: {ct: {file: frames.csv, unit: cm, held_out: [1], noise: {deviation: 0.1 mm, "
           "correlation_length: 4 mm}}}}\n";
    for (const char* name : {"model_0", "model_1"}) run("compare", name);
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }
  static void write(const std::string& name, const std::string& content) { std::ofstream(folder / name) << content; }
  static void run(const std::string& verb, const std::string& name) {
    const ChildEnd end = tether(
        {verb, (folder / (name + ".yaml")).string(), "--output", (folder / name).string(), "--overwrite", "--quiet"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
  }
  static Json compared(const std::string& name) {
    return Json::parse(content_of(folder / name / "comparison.json"))["sources"][0];
  }
  static Json whole(const Json& groups) {
    for (const Json& group : groups)
      if (group["region"].is_null() && group["series"].is_null()) return group;
    return {};
  }
  static Misfit distance(const std::string& name, const char* kind) {
    const Json group = whole(compared(name)[kind]["all_frames"]);
    return {group["l2"], group["in_noise"]["l2"]};
  }
  static Finding candidate(int i, CandidateKind kind, bool accepted) {
    Finding made;
    made.name = fmt::format("effect_{}<i>", i);
    made.where = "spine";
    made.meaning = "no <script>document.documentElement.dataset.errors = 'markup'</script>";
    made.kind = kind;
    made.accepted = accepted;
    made.z = 9.0 - i;
    made.q = 1e-9;
    made.amplitude = {"a.b", "", 1e6, 9e5, 1.1e6, "1", 4e6, false};
    made.confirmed_by_runs = accepted;
    made.retained_information = 0.5;
    return made;
  }
  static Diagnosis diagnosis(Verdict verdict, const char* sentence, std::vector<Finding> effects) {
    Diagnosis made;
    made.case_name = "model_0";
    made.title = "t";
    made.verdict = verdict;
    made.sentences = {sentence};
    made.effects = std::move(effects);
    made.independent_data = 40;
    made.cost = {17, 14, 12, 5};
    return made;
  }
  /// The page of a diagnosis alone: what its head says.
  static Json head_of(const std::string& name, const Diagnosis& diagnosis) {
    fs::create_directories(folder / name);
    write_record(folder / name / "diagnosis.json", diagnosis);
    EXPECT_EQ(tether({"report", (folder / name).string()}).exit_code, 0);
    return found_in(folder / name / "report.html", R"js(
      found = { errors: document.documentElement.dataset.errors || "", chip: document.querySelector(".chip").textContent,
        verdict: document.querySelector(".verdict").textContent,
        list: [...document.querySelectorAll("#head .further li")].map((item) => item.textContent) };)js");
  }
  /// What `tether explain` would say of these two.
  static void explain() {
    fs::create_directories(folder / "diagnosis_0");
    std::vector<Finding> effects;
    for (int i = 0; i < candidates; ++i) effects.push_back(candidate(i, CandidateKind::effect, i == 0));
    Diagnosis diagnosis = ReportPage::diagnosis(Verdict::missing, "MISSING: x", effects);
    diagnosis.table.nothing = 0.01;
    diagnosis.table.groups = {{0.98,
                               0.93,
                               {},
                               {{"effect 0<i>", {}, "spine", CandidateKind::effect, 0.7, 1e6, "1", true},
                                {"effect 1", {}, "spine", CandidateKind::effect, 0.3, {}, "1", false}}}};
    diagnosis.table.combinations = {{{0}, 0.98}};
    diagnosis.table.others = 0.01;
    diagnosis.table.otherwise = {{Assumed::noise, 1.3, 0.05, {0.93}}};
    diagnosis.published = {
        {ModelRole::as_it_is, {}, {{Quantity::distensibility, "", 2.5, {}, {}, "1e-3/mmHg"}}},
        {ModelRole::accepted, {"effect_0<i> at spine"}, {{Quantity::distensibility, "", 2.1, 1.9, 2.25, "1e-3/mmHg"}}}};
    diagnosis.look_alike = (MatrixXd(2, 2) << 1, 0.5, 0.5, 1).finished();
    diagnosis.detectable = {{"x", "", "a.b", 2, "1", 0, 0.4}};
    write_record(folder / "diagnosis_0/diagnosis.json", diagnosis);
    fs::create_directories(folder / "identification_1");
    const EstimateRange range{1e6, 9e5, 1.1e6, 0, 1};
    Estimate estimate;
    estimate.parameters = {{"wall", {}, "g/(cm s2)", "log2", range, range, {}, 1}};
    write_record(folder / "identification_1/estimate.json", estimate);
    write("identification_1/estimate.csv",
          "time [s], wall, wall.lower, wall.upper\n0, 3e6, 1e6, 9e6\n0.1, 1e6, 9e5, 1.1e6\n");
    const ForceLaw law{{{"displacement", -1e5, 2e3, {"pressure"}}}, 0.9, true, "-1e5 displacement"};
    write_record(
        folder / "force.json",
        ForceFound{
            {{"spine", "force_spine", "g/(cm2 s2)", {0, 0.1}, {0, -5}, {-1, -6}, {1, -4}, law}}, {"a force"}, {}});
    write_record(folder / "explain.json", explanation());
  }
  static Explanation explanation() {
    Explanation made;
    made.case_name = "model_0";
    made.title = "A tube & its wall";
    made.verdict = Verdict::missing;
    made.sentences = {"MISSING: support by the spine", "Held-out frames agree"};
    for (const char* name : {"model_0", "model_1"}) {
      ExplainedModel model;
      model.number = static_cast<int>(made.models.size());
      model.name = model.run = name;
      model.case_file = model.run + ".yaml";
      model.training = distance(name, "training");
      model.held_out = distance(name, "held_out");
      made.models.push_back(model);
    }
    made.models[0].diagnosis = "diagnosis_0";
    made.models[1].identification = "identification_1";
    made.best = 1;
    made.missing_force = "force.json";
    made.effects = {candidate(0, CandidateKind::effect, true)};
    made.cost = {3, 2};
    return made;
  }

  static constexpr double step = 4e-3;
  static constexpr int candidates = 15;
  static inline const fs::path folder =
      fs::temp_directory_path() / ("tether_report_page_test_" + std::to_string(getpid()));
};

TEST_F(ReportPage, ShowsBeforeAndAfterInABrowser) {
  explain();
  const ChildEnd end = tether({"report", folder.string()});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(end.output, (folder / "report.html").string() + "\n");
  EXPECT_LT(fs::file_size(folder / "report.html"), 1000000U);

  const Json found = found_in(folder / "report.html", R"js(
    const root = document.documentElement;
    const pixels = (canvas) => {
      const gl = canvas.getContext("webgl"), [w, h] = [canvas.width, canvas.height], all = new Uint8Array(4 * w * h);
      gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
      const colours = new Set();
      let blue = 0, painted = 0;
      for (let i = 0; i < all.length; i += 4) {
        if (!all[i + 3]) continue;
        colours.add((all[i] << 16) | (all[i + 1] << 8) | all[i + 2]);
        blue += all[i + 2] - all[i];
        ++painted;
      }
      return { colours: colours.size, painted: painted / (w * h), blue: blue / painted };
    };
    const walls = [...document.querySelectorAll("canvas.wall")], slider = document.querySelector("input.frame");
    const at = (frame) => {
      slider.value = frame;
      slider.dispatchEvent(new Event("input"));
      return walls.map(pixels);
    };
    found = { state: root.dataset.state, errors: root.dataset.errors || "", verdict: document.querySelector(".verdict").textContent,
      chip: document.querySelector(".chip").textContent, rows: document.querySelectorAll("#ranking tbody tr").length,
      seen: [...document.querySelectorAll("#ranking tbody tr")].filter((row) => row.offsetParent).length,
      names: document.querySelector("#ranking .name").textContent, title: document.title, wide: root.scrollWidth,
      first: at(0), last: at(2), models: document.querySelectorAll("#models tbody tr").length,
      charts: [...document.querySelectorAll(".chart")].filter((chart) => !chart.querySelector("svg")).length,
      published: [...document.querySelectorAll("#published tr")].map((row) => row.textContent.replaceAll("\u00a0", " ")),
      chances: [...document.querySelectorAll("#chances tr")].map((row) => row.textContent),
      sections: [...document.querySelectorAll("section")].map((s) => s.id), tiles: document.querySelector(".tiles").textContent,
      law: document.querySelector("#force .note").textContent.replaceAll("\u00a0", " ") };)js");
  EXPECT_EQ(found["state"], "ready");
  EXPECT_EQ(found["errors"], "");
  EXPECT_EQ(found["verdict"], "Support by the spine");
  EXPECT_EQ(found["chip"], "Missing effect found");
  EXPECT_EQ(found["title"], "A tube & its wall");
  EXPECT_EQ(found["names"], "effect 0<i> · spine") << "text, not markup";
  EXPECT_EQ(found["rows"], candidates);
  EXPECT_EQ(found["seen"], 12) << "the others on demand";
  EXPECT_EQ(found["models"], 2);
  EXPECT_EQ(found["charts"], 0) << "without a drawing";
  EXPECT_LE(found["wide"], 900) << "nothing sticks out";
  const Json expected{"errors",     "wall",   "heat",       "chances", "published",  "ranking", "look-alikes",
                      "detectable", "models", "parameters", "force",   "provenance", "glossary"};
  EXPECT_EQ(found["sections"], expected);
  const Json published{"model as it iswith what was foundeffect 0<i> at spine",
                       "distensibility [1 × 10⁻³/mmHg]2.52.11.9 to 2.25"};
  EXPECT_EQ(found["published"], published);
  const Json chances{
      "effect 0<i> · spine, or what does much the same"
      "effect 0<i> · spine 70 % at about 1 × 10⁶; effect 1 · spine 30 %98 %",
      "Nothing is missing1 %", "Something that the catalogue does not have< 1 %", "Anything else1 %"};
  EXPECT_EQ(found["chances"], chances);
  const Json before = found["last"][0], after = found["last"][1];
  for (const Json& wall : {before, after}) {
    EXPECT_GT(wall["colours"], 20) << wall;
    EXPECT_GT(wall["painted"], 0.05) << wall;
  }
  const auto blue = [](const Json& wall) { return wall["blue"].get<double>(); };  // more than red
  const double mean = whole(compared("model_0")["moments"][2]["groups"])["mean"];
  EXPECT_GT((blue(before) - blue(after)) * (mean < 0 ? 1 : -1), 10) << "blue where the data lie inside the model; the "
                                                                       "second model is at the data";
  EXPECT_GT(std::abs(blue(before) - blue(found["first"][0])), 5) << "the slider changes the colours";
  const std::string held_out = fmt::format("{:.2f}", 10 * distance("model_0", "held_out").length);
  const std::string tiles = found["tiles"];
  EXPECT_NE(tiles.find(held_out), std::string::npos) << tiles;
  EXPECT_NE(tiles.find("Runs of the model173 s of CPU"), std::string::npos) << tiles;
  EXPECT_EQ(found["law"],
            "−1 × 10⁵ displacement explains 90 % of the force. displacement: −1 × 10⁵ ± 2000, in whose "
            "place pressure would do as well");
}

TEST_F(ReportPage, ListsWhatCannotBeToldApart) {
  std::vector<Finding> effects;
  for (int i = 0; i < 4; ++i) effects.push_back(candidate(i, CandidateKind::effect, i == 0));
  for (int i = 0; i < 3; ++i) effects[i].group = "1";
  for (int i = 1; i < 3; ++i) effects[i].rival = true;
  effects.push_back(candidate(4, CandidateKind::data, true));
  effects.push_back(candidate(5, CandidateKind::numerics, true));
  const Json found =
      head_of("ambiguous", diagnosis(Verdict::ambiguous, "AMBIGUOUS: in words that nobody reads", effects));
  EXPECT_EQ(found["errors"], "");
  EXPECT_EQ(found["chip"], "Cannot tell which");
  EXPECT_EQ(found["verdict"], "These data cannot tell 3 effects from each other");
  const std::string amount = "<i> · spine, 1 (0.9 … 1.1) × 10⁶";
  const Json expected{"Effect 0" + amount, "Effect 1" + amount, "Effect 2" + amount,
                      "The data are off: effect 4" + amount, "The numerics are too coarse: effect 5" + amount};
  EXPECT_EQ(found["list"], expected);
}

TEST_F(ReportPage, AnErrorOfTheDataIsNoMissingEffect) {
  const std::vector<Finding> error{candidate(0, CandidateKind::data, true)};
  const Json off = head_of("off", diagnosis(Verdict::missing, "in words that nobody reads", error));
  EXPECT_EQ(off["errors"], "");
  EXPECT_EQ(off["chip"], "The data are off");
  EXPECT_EQ(off["verdict"], "In words that nobody reads");
  const std::vector<Finding> effects{candidate(0, CandidateKind::numerics, true),
                                     candidate(1, CandidateKind::effect, false)};
  EXPECT_EQ(head_of("coarse", diagnosis(Verdict::missing, "x", effects))["chip"], "The numerics are too coarse");
}

TEST_F(ReportPage, OfAComparisonAloneAndWithoutItsWall) {
  const std::string run = (folder / "model_0").string();
  ASSERT_EQ(tether({"report", run}).exit_code, 0);
  const std::string script =
      "found = {errors: document.documentElement.dataset.errors || '', walls: "
      "document.querySelectorAll('canvas.wall').length, notes: [...document.querySelectorAll('.note')].map((n) => "
      "n.textContent).join()};";
  const Json found = found_in(folder / "model_0/report.html", script);
  EXPECT_EQ(found["errors"], "");
  EXPECT_EQ(found["walls"], 1);

  fs::rename(folder / "frame_28.stl", folder / "kept.stl");  // the report shows what was compared
  ASSERT_EQ(tether({"report", run}).exit_code, 0);
  EXPECT_EQ(found_in(folder / "model_0/report.html", script)["walls"], 1);
  fs::rename(folder / "kept.stl", folder / "frame_28.stl");

  fs::rename(folder / "model_0/wall.json", folder / "wall.json");
  ASSERT_EQ(tether({"report", run}).exit_code, 0);
  const Json without = found_in(folder / "model_0/report.html", script);
  EXPECT_EQ(without["errors"], "");
  EXPECT_EQ(without["walls"], 0);
  EXPECT_NE(without["notes"].get<std::string>().find("wall.json: no such file"), std::string::npos) << without["notes"];
  fs::rename(folder / "wall.json", folder / "model_0/wall.json");

  const ChildEnd nothing = tether({"report", (folder / "none").string()});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.errors.find("none: is not a folder of results"), std::string::npos) << nothing.errors;
}

}  // namespace browser_test
}  // namespace tether
