#pragma once

#include <utility>

#include "common/base/child_process.hpp"

namespace tether {

/// A line of mpirun as a user of any name starts it, root of a container too; more is added to its environment.
inline Command on_mpirun(const std::vector<std::string>& programs,
                         std::vector<std::pair<std::string, std::string>> more = {}) {
  Command line{{"mpirun", "-q", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"},
               std::move(more)};
  line.words.insert(line.words.end(), programs.begin(), programs.end());
  line.environment.insert(line.environment.end(),
                          {{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}});
  return line;
}

}  // namespace tether
