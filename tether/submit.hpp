#pragma once

namespace tether {

// Verbs that have options of their own; the arguments behind the verb's name. All return the exit code.

/// tether submit VERB CASE.yaml|FOLDER: writes a job of Slurm and submits it, or with --dry-run shows it.
int submit(int argc, char** argv);
/// tether status FOLDER: what became of each case of a job.
int job_status(int argc, char** argv);
/// tether results FOLDER: one table of what its cases found: results.csv.
int job_results(int argc, char** argv);

}  // namespace tether
