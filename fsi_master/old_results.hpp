#pragma once

#include <filesystem>

/// What a new run takes away of an earlier one in its folder. Files of others stay, in its folders too.
namespace tether {

/// The comparison of a run, its pictures and page: nothing of them may be taken for this one's. What other verbs made
/// by runs of their own stays.
void remove_what_was_made_of_runs(const std::filesystem::path& output);

/// Without --resume nothing of an earlier run may be taken for this one's either.
void remove_old_results(const std::filesystem::path& output);

}  // namespace tether
