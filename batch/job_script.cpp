#include "batch/job_script.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "common/base/shell_quoted.hpp"

namespace tether {
namespace {

std::string option(const std::string& name, const std::string& value) {
  return value.empty() ? "" : fmt::format("#SBATCH --{}={}\n", name, value);
}

std::string header(const Job& job, const std::filesystem::path& folder) {
  const JobResources& r = job.resources;
  const bool is_array = job.cases.size() > 1;
  std::string text = option("job-name", job_name(job, folder)) + option("nodes", std::to_string(r.nodes)) +
                     option("ntasks-per-node", std::to_string(r.tasks_per_node)) + option("mem", r.memory) +
                     option("time", r.time) + option("account", r.account) + option("partition", r.partition);
  if (is_array) text += option("array", fmt::format("0-{}", job.cases.size() - 1));
  text += option("output", (folder / job_files / (is_array ? "slurm-%A_%a.txt" : "slurm-%j.txt")).string());
  text += option("signal", fmt::format("B:USR1@{}", seconds_to_end));
  text += "#SBATCH --open-mode=append\n#SBATCH --requeue\n";
  for (const std::string& more : r.more) text += fmt::format("#SBATCH --{}\n", more);
  return text;
}

std::string list(const char* name, const std::vector<JobCase>& cases, std::string JobCase::*field) {
  std::string text = fmt::format("{}=(\n", name);
  for (const JobCase& one : cases) text += fmt::format("  {}\n", shell_quoted(one.*field));
  return text + ")\n";
}

constexpr const char* body = R"(
k=${SLURM_ARRAY_TASK_ID:-0}
name=${names[$k]} output=$folder/${names[$k]}
this_job=${SLURM_ARRAY_JOB_ID:+${SLURM_ARRAY_JOB_ID}_$k}  # without the task it would be the whole array
this_job=${this_job:-$SLURM_JOB_ID}
begun=$folder/job/ended/$name.begun
resume=$(go_on)
rm -f "$folder/job/ended/$name"
touch "$begun"
# For tether status: the job's number, and the cluster where that is not the one of who submits.
echo "${SLURM_ARRAY_JOB_ID:-$SLURM_JOB_ID}${clusters:+;$SLURM_CLUSTER_NAME}" >"$folder/job/number"

# What programs leave of the state that they have come to.
saved() {
  find "$output" -newer "$begun" \( -path '*/checkpoint/*' -o -name run.json -o -name steps.json -o -name summary.json \) | grep -q .
}

# One model stays on one node: the programs are told which there are. A diagnosis calls mpirun twice, whose steps share the job.
TETHER_NODES=$(scontrol show hostnames "$SLURM_JOB_NODELIST" | paste -sd,)
export TETHER_NODES SLURM_OVERLAP=1

# Whether all nodes of the job are there: asked of each, since Slurm itself notices the loss of one after SlurmdTimeout only.
all_answer() { timeout 60 srun --nodes="$SLURM_JOB_NUM_NODES" --ntasks="$SLURM_JOB_NUM_NODES" --ntasks-per-node=1 true 2>/dev/null; }

# The job begins anew, from what is saved.
begin_anew() {
  if scontrol requeue "$this_job"; then
    sleep 60  # until Slurm ends this script
  else
    echo "$name: sbatch $folder/job/script.sh goes on from what is saved"
  fi
}

# The time is nearly over: the programs save what they have come to.
told=
trap 'told=yes; kill -USR1 "$program" 2>/dev/null' USR1
"$tether" "$verb" "${cases[$k]}" --output "$output" $options $resume >>"$folder/job/$name.log" 2>&1 &
program=$!
wait "$program"; code=$?
while kill -0 "$program" 2>/dev/null; do wait "$program"; code=$?; done  # a signal ends `wait`, not the program
if [ "$code" -ne 0 ]; then
  if [ -n "$told" ] && ! saved; then
    echo "$name: out of time before anything was saved: it needs a longer --time"
  elif [ -n "$told" ] || scontrol show job "$this_job" | grep -q ' PreemptTime=[0-9]'; then
    echo "$name: out of time, or preempted"
    begin_anew
  elif [ "$SLURM_JOB_NUM_NODES" -gt 1 ] && ! all_answer; then
    echo "$name: a node does not answer; Slurm starts the job again without it when it has noticed"
    for _ in {1..15}; do
      sleep 10  # until Slurm ends this script, or the node is there again
      all_answer && break
    done
    begin_anew
  fi
fi
echo "$code" >"$folder/job/ended/$name"
exit "$code"
)";

}  // namespace

std::string job_name(const Job& job, const std::filesystem::path& folder) {
  return "tether-" + (job.cases.size() == 1 ? job.cases.front().name : folder.filename().string());
}

std::string asked_clusters(const JobResources& resources) {
  std::string asked;
  for (const std::string& more : resources.more)
    for (const std::string option : {"clusters=", "cluster="})
      if (more.starts_with(option)) asked = more.substr(option.size());
  return asked;
}

std::string job_script(const Job& job, const std::filesystem::path& folder) {
  if (folder.string().find_first_of(" \t\n\"'\\%$`") != std::string::npos)
    throw input_error(
        "{}: sbatch takes no folder with spaces, quotes, \\, %, $ or ` in its path; choose another by "
        "--output",
        folder.string());
  const char* verb = word_of(job.verb);
  std::string text = fmt::format("#!/bin/bash\n# Written by tether submit {}.\n", verb) + header(job, folder);
  text +=
      fmt::format("\ntether={} verb={} folder={}\n", shell_quoted(job.program), verb, shell_quoted(folder.string()));
  text += fmt::format("options={}\n", makes_many_runs(job.verb)
                                          ? shell_quoted(fmt::format("--processes {}", job.resources.processes))
                                          : "");
  const std::string clusters = asked_clusters(job.resources);
  text += "clusters=" + (clusters.empty() ? "${SBATCH_CLUSTERS:-$SLURM_CLUSTERS}" : shell_quoted(clusters)) + "\n";
  text += list("names", job.cases, &JobCase::name) + list("cases", job.cases, &JobCase::case_file);
  const char* saved = job.verb == JobVerb::identify ? "identification" : "master";  // one folder may have both
  text +=
      is_resumed(job.verb)
          ? fmt::format(
                "go_on() {{ [ -e \"$begun\" ] && ls \"$output\"/checkpoint*/{}.* &>/dev/null && echo --resume; }}\n",
                saved)
          : "go_on() { :; }  # it finds by itself what was made\n";
  return text + body;
}

}  // namespace tether
