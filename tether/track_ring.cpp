#include "vessel/ring/track_ring.hpp"

#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "tether/new_results.hpp"
#include "tether/verbs.hpp"
#include "vessel/ring/ring_text.hpp"

namespace tether {

namespace fs = std::filesystem;

Made<TrackedRing> track_ring(const CommandLine& command) {
  const RingTrackCase asked = read_ring_case(command.case_file);
  check_tables(asked);
  const MadeOfFile made{"track-ring", asked.name};
  const fs::path folder = hold_for_made(command, made);
  TrackedRing ring = track_ring(asked);
  const NewResults results(folder, {"ring.json", "poses.csv", "plots/ring.png"});
  write_record(results.beside("ring.json"), ring);
  write_poses(results.beside("poses.csv"), ring);
  mark_made(folder, made.verb, command.case_file);  // nothing speaks against new results any more
  results.put_in_place();
  std::string told = text_of(ring) + fmt::format("In {}: ring.json, poses.csv", folder.string());
  if (draw_ring(folder)) told += ", plots/ring.png";
  told += fmt::format("\nFor a case: motion: {{file: {}, table: poses, period: ..., harmonics: 3}}\n",
                      (folder / "poses.csv").string());
  return {std::move(ring), told};
}

void check_ring(const CommandLine& command) {
  check_tables(read_ring_case(command.case_file));
}

}  // namespace tether
