#include <fstream>
#include <regex>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/config/describe.hpp"
#include "common/config/output_folder.hpp"
#include "common/config/overlay.hpp"
#include "common/io/vtp_writer.hpp"
#include "diagnosis/comparison/finished_run.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "tether/verbs.hpp"
#include "twin/answer.hpp"
#include "twin/twin_data.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* twin_verb = "twin";
constexpr const char* source_name = "twin";
constexpr const char* case_name = "case.yaml";

/// A case with a section `twin`.
struct CaseWithTwin {
  explicit CaseWithTwin(const fs::path& path) : file(path) {
    std::optional<TwinCase> given;
    file.read("twin", given);
    file.read("observations", observations);
    file.finish();
    if (!given) throw input_error("{}: must be given, to make a twin", file.where("twin"));
    twin = std::move(*given);
  }
  CaseFile file;
  TwinCase twin;
  ObservationsCase observations;
};

/// The run that the data are made from.
struct Truth {
  Truth(const fs::path& case_file, const fs::path& run_folder)
      : own(case_file),
        surface(own.lumen()),
        run(run_folder),
        motion(motion_of(run, surface)),
        series(run_folder / "timeseries.csv", TableOf::tether) {}
  TrueLumen lumen() const { return {surface.triangles, motion.positions, motion.start, motion.end}; }

  ObservedCase own;
  LumenSurface surface;
  FinishedRun run;
  RunMotion motion;
  CsvTable series;
};

/// What has the names of a twin's frames.
std::vector<fs::path> frames_in(const fs::path& folder) {
  const std::regex frame("lumen_[0-9]+\\.vtp");
  std::vector<fs::path> frames;
  if (!fs::exists(folder / "data")) return frames;
  for (const auto& entry : fs::directory_iterator(folder / "data"))
    if (std::regex_match(entry.path().filename().string(), frame)) frames.push_back("data" / entry.path().filename());
  return frames;
}

/// Held; what is in it is as it was. Data are measurements for whoever changes them: they are kept as a case is.
fs::path hold_folder_of(const CommandLine& command, const CaseWithTwin& given) {
  MadeOfFile made{twin_verb,
                  given.file.common().name + "_twin",
                  {given.twin.truth},
                  {case_name, "data/lumen.csv"},
                  sealed_answer({})};
  for (const auto& [name, trace] : given.twin.traces) made.to_go_on_with.push_back("data/" + name + ".csv");
  const fs::path folder = hold_for_made(command, made);
  for (const char* part : {"data", "sealed"})
    if (fs::exists(folder / part) && !fs::is_directory(folder / part))
      throw input_error("{}: is not a folder", (folder / part).string());
  made.to_go_on_with = frames_in(folder);
  check_keeps_work(folder, made, command.overwrite);
  if (command.overwrite) note_as_they_are(folder, made.to_go_on_with);
  return folder;
}

/// Not what else stands in its folders.
void remove_twin(const fs::path& folder) {
  for (const fs::path& old : {folder / case_name, sealed_answer(folder), folder / "data/lumen.csv"}) fs::remove(old);
  fs::create_directories(folder / "data");
  for (const fs::path& old : frames_in(folder)) fs::remove(folder / old);
}

/// What a twin consists of, written beside the one that is there: that one stays if this one cannot be made.
class NewTwin {
 public:
  explicit NewTwin(const fs::path& folder) : folder_(folder) {
    remove();
    fs::create_directories(data());
  }
  ~NewTwin() { remove(); }
  NewTwin(const NewTwin&) = delete;
  NewTwin& operator=(const NewTwin&) = delete;

  fs::path data() const { return folder_ / ".new_twin"; }
  fs::path answer() const { return folder_ / ".new_twin.json"; }
  fs::path case_file() const { return folder_ / ".new_twin.yaml"; }
  /// Before the one that is there goes.
  void note() const {
    std::vector<ComingFile> coming{{case_name, case_file()}};
    for (const auto& entry : fs::directory_iterator(data()))
      coming.push_back({"data" / entry.path().filename(), entry.path()});
    note_coming(folder_, coming);
  }
  /// The case last: where it is, the twin is whole.
  void put_in_place() const {
    for (const auto& entry : fs::directory_iterator(data()))
      ::tether::put_in_place(entry.path(), folder_ / "data" / entry.path().filename());
    ::tether::put_in_place(answer(), sealed_answer(folder_));
    ::tether::put_in_place(case_file(), folder_ / case_name);
  }

 private:
  void remove() const {
    std::error_code none;
    for (const fs::path& part : {data(), answer(), case_file()}) fs::remove_all(part, none);
  }

  fs::path folder_;
};

void write_frames(const fs::path& folder, const std::vector<TwinFrame>& frames) {
  std::ofstream list(folder / "lumen.csv");
  list << "file, time [s]\n";
  for (const TwinFrame& frame : frames) {
    const std::string name = fmt::format("lumen_{:02}.vtp", frame.number);
    write_vtp(folder / name, frame.surface.points, frame.surface.triangles);
    list << fmt::format("{}, {}\n", name, frame.time);
  }
  if (!list.flush()) throw write_error(folder / "lumen.csv");
}

void write_trace(const fs::path& file, const TwinTrace& trace, const std::string& unit) {
  std::ofstream table(file);
  table << fmt::format("time [s], value{}\n", unit.empty() ? "" : " [" + unit + "]");
  for (std::size_t i = 0; i < trace.times.size(); ++i)
    table << fmt::format("{}, {}\n", trace.times[i], trace.values[i]);
  if (!table.flush()) throw write_error(file);
}

std::string text_of(const NoiseCase& noise, double deviation) {
  return fmt::format("{{deviation: {}, correlation_length: {}, correlation_time: {}}}", number_text(deviation),
                     number_text(noise.correlation_length), number_text(noise.correlation_time));
}

/// The frames as a source; their errors are those of the image and the noise.
std::string source_of(const CaseWithTwin& given, const TwinFrames& frames) {
  const TwinCase& twin = given.twin;
  std::string text = fmt::format("{{file: data/lumen.csv, unit: {}", given.file.units().symbol(dimension::length));
  if (twin.periodic) text += fmt::format(", period: {}", number_text(*twin.beat));
  if (!twin.held_out.empty()) text += fmt::format(", held_out: [{}]", fmt::join(twin.held_out, ", "));
  return text + ", noise: " + text_of(twin.noise, std::hypot(twin.noise.deviation, frames.image_error)) + "}";
}

std::string source_of(const std::string& name, const TwinTraceCase& trace) {
  return fmt::format("{{observable: {}, quantity: {},{} curve: {{file: data/{}.csv}}, noise: {}}}", trace.observable,
                     trace.quantity, trace.quantity == "pressure" ? " absolute: false," : "", name,
                     text_of(trace.noise, trace.noise.deviation));
}

/// The case without its section `twin`, with the twin's data in the place of its own measurements.
void write_case(const fs::path& file, const CaseWithTwin& given, const TwinFrames& frames) {
  const CommonCase& common = given.file.common();
  Overlay overlay{given.file.path(), common.name + "_blind", common.titled(", against data of a twin"), {{"twin", ""}}};
  const auto set = [&](const std::string& kind, const std::string& name, const std::string& text) {
    overlay.values.push_back({"observations." + kind + "." + name, text});
  };
  const auto is_made = [&](const std::string& name) {
    return std::any_of(given.twin.traces.begin(), given.twin.traces.end(),
                       [&](const auto& trace) { return trace.first == name; });
  };
  const auto is_replaced = [&](const MeasurementKind& kind, const std::string& name) {
    return &kind == &kinds::traces ? is_made(name) : &kind == &kinds::surfaces && name == source_name;
  };
  for (const auto& section : given.observations.sections())
    for (const std::string& name : section->names())
      if (!is_replaced(section->kind(), name)) set(section->kind().name, name, "");
  set("surfaces", source_name, source_of(given, frames));
  for (const auto& [name, trace] : given.twin.traces) set("traces", name, source_of(name, trace));
  write_overlay(file, overlay);
}

void check(const CaseWithTwin& given, const CaseFile& truth) {
  const std::string &ours = given.file.units().name(), &its = truth.units().name();
  if (ours != its)
    throw input_error("{}: the truth's units are {}, the case's {}: they must be the same",
                      given.file.where("twin.truth"), its, ours);
  if (given.twin.periodic && !given.twin.beat)
    throw input_error("{}: must be given with periodic", given.file.where("twin.beat"));
  for (const auto& [name, trace] : given.twin.traces)
    if (name == "lumen")
      throw input_error("{}: data/lumen.csv lists the surfaces: another name is needed",
                        given.file.where("twin.traces.lumen"));
}

struct TwinData {
  TwinFrames frames;
  std::vector<TwinTrace> traces;  ///< one for each of the case
};

TwinData make_data(const CaseWithTwin& given, const Truth& truth) {
  const TrueLumen lumen = truth.lumen();
  const double first = times_of_frames(given.twin, lumen).front();
  check_scales(given.twin, given.file.units(), lumen, first,
               [&](const std::string& field) { return given.file.where(field); });
  TwinData data{make_frames(given.twin, given.file.units(), lumen, given.file.where("twin")), {}};
  std::uint64_t seed = static_cast<std::uint64_t>(given.twin.seed) * 16 + 8;
  for (const auto& [name, trace] : given.twin.traces)
    data.traces.push_back(
        make_trace(trace, truth.series.numbers("time"), truth.series.numbers(trace.observable), first, seed++));
  return data;
}

void write_data(const fs::path& folder, const TwinData& data, const CaseWithTwin& given, const Truth& truth) {
  write_frames(folder, data.frames.frames);
  auto made = data.traces.begin();
  for (const auto& [name, trace] : given.twin.traces)
    write_trace(folder / (name + ".csv"), *made++, truth.series.unit(trace.observable));
}

void write(const NewTwin& twin, const TwinData& made, const CaseWithTwin& given, const Truth& truth) {
  try {
    write_data(twin.data(), made, given, truth);
    Answer answer = answer_of(given.twin);
    answer.image_error = made.frames.image_error;
    seal(twin.answer(), answer);
    write_case(twin.case_file(), given, made.frames);
  } catch (const RunError& error) {
    throw run_error("{}\nthe truth's run is kept, and a twin that was there is as it was: the same command goes on",
                    error.what());
  }
}

std::string where_frames_are(const fs::path& folder, const TwinFrames& made, const UnitSystem& units) {
  const fs::path file = folder / "case.yaml";
  return fmt::format(
      "{} surfaces, {:.3g} {} from the truth before noise.\nIn {}:\n  data/       surfaces, their times, traces\n"
      "  case.yaml   the model with these data: tether compare {}\n  sealed/     the answer, for tether score\n",
      made.frames.size(), made.image_error, units.symbol(dimension::length), folder.string(), file.string());
}

}  // namespace

Made<std::filesystem::path> make_twin(const CommandLine& command) {
  check_case(command);
  const CaseWithTwin given(command.case_file);
  CommandLine run = command;
  run.case_file = given.twin.truth;
  const CaseFile truth_file(run.case_file);
  check(given, truth_file);
  const fs::path folder = hold_folder_of(command, given);
  run.output = folder / "sealed" / "run";
  provide_run(run, truth_file, run.output);
  const Truth truth(run.case_file, run.output);
  const TwinData made = make_data(given, truth);
  const NewTwin beside(folder);
  write(beside, made, given, truth);
  mark_made(folder, twin_verb, command.case_file);
  beside.note();
  remove_twin(folder);
  beside.put_in_place();
  return {folder / "case.yaml", where_frames_are(folder, made.frames, given.file.units())};
}

void check_twin(const CommandLine& command) {
  CaseFile file(command.case_file);
  std::optional<TwinCase> twin;
  file.read("twin", twin);
  file.finish();
}

std::string describe_twin(const std::string& format) {
  Describe describe(UnitSystem::cgs());
  TwinCase twin;
  describe.group("twin", twin, meaning_of_section("twin"));
  return format == "markdown" ? describe.markdown() : describe.text();
}

}  // namespace tether
