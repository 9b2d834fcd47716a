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

/// noise.json, its plots, and what is told of them.
Made<NoiseMeasurements> written(NoiseMeasurements noise, const fs::path& output) {
  noise.sentences = sentences_of(noise.measurements);
  write_record(output / "noise.json", noise);
  std::string told = text_of(noise) + fmt::format("In {}:\n  noise.json\n", output.string());
  for (const std::string& name : draw_noise(noise, output)) told += fmt::format("  plots/{}\n", name);
  return {std::move(noise), std::move(told)};
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
  hold_output(output);
  provide_run(command, measured.file, output, data.points());
  const FinishedRun run(output);
  const RunMotion motion = motion_of(run, lumen);
  NoiseMeasurements noise;
  noise.case_name = measured.file.common().name;
  for (const auto& seen : {repeated_noise(data, motion), noise_at_rest(data, motion), residual_noise(data, motion)})
    for (const SeenNoise& one : seen)
      noise.measurements.push_back(measured_noise(one, measured.file.units().symbol(dimension::length)));
  return written(std::move(noise), output);
}

Made<NoiseMeasurements> measure_noise(const fs::path& first, const fs::path& second, const fs::path& output) {
  hold_output(output);
  SeenNoise seen = noise_of_both(first, second);
  seen.source = first.filename().string() + " and " + second.filename().string();
  seen.frames = {first.filename().string(), second.filename().string()};
  NoiseMeasurements noise;
  noise.case_name = seen.source;
  noise.measurements.push_back(measured_noise(seen, ""));
  return written(std::move(noise), output);
}

int measure_noise_of_files(int argc, char** argv) {
  const std::string option = argc > 2 ? argv[2] : "";
  if (argc != 2 && !(argc == 4 && option == "--output")) {
    std::cerr << "tether measure-noise FIRST SECOND [--output DIR]: two surfaces of the same moment\n";
    return exit_input_wrong;
  }
  return guarded("tether measure-noise", [&] {
    std::cout << measure_noise(argv[0], argv[1], argc == 4 ? argv[3] : "out/noise").told;
    return exit_done;
  });
}

}  // namespace tether
