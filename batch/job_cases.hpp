#pragma once

#include <filesystem>
#include <vector>

#include "batch/job.hpp"

namespace tether {

/// The cases that a path means: a case file itself; of a folder each CASE.yaml in it and each NAME/case.yaml, by name.
/// Throws InputError if there is none, two have the same name, or one cannot be a folder's.
std::vector<JobCase> job_cases(const std::filesystem::path& given);

/// A case for each row of a table, which builds on `base`: column `name`, and one for each field that differs, by its
/// place in the case, "solid.material.young [g/(cm s2)]". An empty cell leaves it as it is; one that begins with [ or {
/// is a list or a section; any other is a text, whatever it would mean in YAML. Written into `folder`.
/// Throws InputError "table:row: ..." for what cannot be written, and as the table does.
std::vector<JobCase> job_cases_of_table(const std::filesystem::path& base, const std::filesystem::path& table,
                                        const std::filesystem::path& folder);

/// What is said against a case, by its row of the table instead of the file that was made of it.
std::string told_by_row(const JobCase& one, const std::string& message);

}  // namespace tether
