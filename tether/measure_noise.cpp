#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/comparison/finished_run.hpp"
#include "diagnosis/noise/noise_text.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "observation_manager/measurements/surface_check.hpp"
#include "observation_manager/measurements/surface_files.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// noise.json, its plots, and what is told of them. left_out: of what could not be measured.
Made<NoiseMeasurements> written(NoiseMeasurements noise, const fs::path& output,
                                const std::vector<std::string>& left_out = {}) {
  noise.sentences = sentences_of(noise.measurements);
  noise.sentences.insert(noise.sentences.end(), left_out.begin(), left_out.end());
  write_record(output / "noise.json", noise);
  std::string told = text_of(noise) + fmt::format("In {}:\n  noise.json\n", output.string());
  for (const std::string& name : draw_noise(noise, output)) told += fmt::format("  plots/{}\n", name);
  return {std::move(noise), std::move(told)};
}

/// Of a pair that was measured before.
void remove_noise(const fs::path& output) {
  fs::remove(output / "noise.json");
  if (!fs::is_directory(output / "plots")) return;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(output / "plots"))
    if (entry.path().filename().string().starts_with("noise_repeated_")) old.push_back(entry.path());
  for (const fs::path& file : old) fs::remove(file);
}

TriangleSurface surface_in(const fs::path& file) {
  return checked_surface(file.string(), read_surface(file, 1)).surface;
}

SeenNoise noise_of_both(const fs::path& first, const fs::path& second) {
  const TriangleSurface one = surface_in(first), other = surface_in(second);
  try {
    return noise_between(one, other);
  } catch (const InputError& error) {
    throw input_error("{} and {}: {}", first.string(), second.string(), error.what());
  }
}

}  // namespace

Made<NoiseMeasurements> measure_noise(const CommandLine& command) {
  check_case(command);
  const ObservedCase measured(command.case_file);
  const LumenSurface lumen = measured.lumen();
  const Observations data = load_observations(measured.observations, lumen, measured.file);
  if (data.lumen.empty())
    throw input_error("{}: has no surfaces or contours whose noise could be measured",
                      measured.file.where("observations"));
  const fs::path output = output_of(command, measured.file);
  check_keeps_inputs(output, command.case_file);
  hold_output(output);
  provide_run(command, measured.file, output, data.points());
  const FinishedRun run(output);
  const RunMotion motion = motion_of(run, lumen);
  NoiseMeasurements noise;
  noise.case_name = measured.file.common().name;
  std::vector<SeenNoise> measurable;
  std::vector<std::string> left_out;
  for (const auto& seen : {repeated_noise(data, motion), noise_at_rest(data, motion), residual_noise(data, motion)})
    for (const SeenNoise& one : seen)
      if (can_be_measured(one.fields))
        measurable.push_back(one);
      else
        left_out.push_back(fmt::format("{}, from {}: too few data in each frame", one.source, meaning_of(one.from)));
  noise.measurements = measured_noise(measurable, measured.file.units().symbol(dimension::length));
  if (noise.measurements.empty()) throw run_error("noise cannot be measured: {}", fmt::join(left_out, "; "));
  return written(std::move(noise), output, left_out);
}

Made<NoiseMeasurements> measure_noise(const fs::path& first, const fs::path& second, const fs::path& output,
                                      bool overwrite) {
  SeenNoise seen = noise_of_both(first, second);  // before the folder is touched
  claim_for_made(output, overwrite, "measure-noise", {first, second});
  remove_noise(output);
  seen.source = first.filename().string() + " and " + second.filename().string();
  seen.frames = {first.filename().string(), second.filename().string()};
  NoiseMeasurements noise;
  noise.case_name = seen.source;
  noise.measurements.push_back(measured_noise(seen, ""));
  return written(std::move(noise), output);
}

int measure_noise_of_files(int argc, char** argv) {
  fs::path output = "out/noise";
  bool overwrite = false, known = argc >= 2;
  for (int i = 2; known && i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--overwrite")
      overwrite = true;
    else if (option == "--output" && i + 1 < argc)
      output = argv[++i];
    else
      known = false;
  }
  if (!known) {
    std::cerr << "tether measure-noise FIRST SECOND [--output DIR] [--overwrite]: two surfaces of the same moment\n";
    return exit_input_wrong;
  }
  return guarded("tether measure-noise", [&] {
    std::cout << measure_noise(argv[0], argv[1], output, overwrite).told;
    return exit_done;
  });
}

}  // namespace tether
