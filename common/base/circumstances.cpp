#include "common/base/circumstances.hpp"

#include <sys/resource.h>

#include <array>

#include "common/base/error.hpp"
#include "common/base/temporary_folder.hpp"

namespace tether {
namespace {

constexpr double kb = 1024, mb = 1e6;

struct Need {
  __rlimit_resource of;
  double least;  ///< measured with Open MPI 4.1 (decision 118): below it mpirun or a program does not begin
  const char* what;
  double unit;
  const char* unit_name;
  const char* option;
};
constexpr std::array needs{Need{RLIMIT_NOFILE, 40, "may be open at once", 1, "files", "-n"},
                           Need{RLIMIT_AS, 400 * mb, "may be taken by a program", mb, "MB of memory", "-v"},
                           Need{RLIMIT_FSIZE, 4096 * kb, "may be in a file", mb, "MB", "-f"},
                           // with 208 kB mpirun ends by signal 11, with 256 an explanation, with 288 none of them
                           Need{RLIMIT_STACK, 512 * kb, "may be taken by a program's stack", kb, "kB", "-s"}};

void check(const Need& need) {
  rlimit limit{};
  if (getrlimit(need.of, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  if (const auto given = static_cast<double>(limit.rlim_cur); given < need.least)
    throw run_error("only {:.3g} {} {} (ulimit {}): at least {:.3g} are needed", given / need.unit, need.unit_name,
                    need.what, need.option, need.least / need.unit);
}

}  // namespace

void check_circumstances(double free_mb) {
  for (const Need& need : needs) check(need);
  std::error_code error;
  const std::filesystem::path folder = temporary_folder();
  const auto space = std::filesystem::space(folder, error);
  if (const double left = static_cast<double>(space.available) / mb; !error && left < free_mb)
    throw run_error("{}: {:.1f} MB are left on its disk, of which a run needs {:.0f}: TMPDIR=FOLDER takes another one",
                    folder.string(), left, free_mb);
}

}  // namespace tether
