#include "fluid/windkessels/fit_outlets.hpp"

#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "fluid/windkessels/outlets_text.hpp"
#include "tether/new_results.hpp"
#include "tether/verbs.hpp"

namespace tether {

namespace fs = std::filesystem;

Made<FittedOutlets> fit_outlets(const CommandLine& command) {
  const OutletsCase asked = read_outlets_case(command.case_file);
  std::vector<fs::path> also;
  if (!asked.case_file.empty()) also.push_back(asked.case_file);
  const MadeOfFile made{"fit-outlets", asked.name, also, {"case.yaml"}, "outlets.json"};
  const fs::path folder = hold_for_made(command, made);
  OutletsFit fit = [&] {
    try {
      return fit_outlets(asked, folder);
    } catch (const InputError& error) {
      throw input_error("{}: {}", command.case_file.string(), error.what());
    }
  }();
  const NewResults results(folder, {"outlets.json", "outlets.csv", "case.yaml", "plots/outlets.png"});
  write_record(results.beside("outlets.json"), fit.result);
  write_beat(results.beside("outlets.csv"), fit);
  if (fit.overlay) write_overlay(results.beside("case.yaml"), *fit.overlay);
  mark_made(folder, made.verb, command.case_file);  // nothing speaks against new results any more
  results.note(made.to_go_on_with);
  results.put_in_place();
  std::string told = text_of(fit.result) + fmt::format("In {}: outlets.json, outlets.csv", folder.string());
  if (draw_outlets(folder, fit)) told += ", plots/outlets.png";
  if (fit.overlay) told += fmt::format(", case.yaml: tether simulate {}", (folder / "case.yaml").string());
  return {std::move(fit.result), told + "\n"};
}

void check_outlets(const CommandLine& command) {
  read_outlets_case(command.case_file);
}

}  // namespace tether
