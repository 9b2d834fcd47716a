#include "common/linalg/blas_kernels.hpp"

#include <cstdlib>

#include "common/base/error.hpp"

extern "C" {
void openblas_set_num_threads(int);
char* openblas_get_corename();
void dpotrf_(const char*, const int*, double*, const int*, int*);
// Of libraries built for many processors; null in others.
void gotoblas_dynamic_init() __attribute__((weak));
void gotoblas_dynamic_quit() __attribute__((weak));
}

namespace tether {
namespace {

/// What OpenBLAS calls the newest kernels that this processor can run; null if there is nothing better than SSE3.
const char* best_kernels() {
#ifdef __x86_64__
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  if (avx512) return "SkylakeX";
  if (avx2) return "Haswell";
#endif
  return nullptr;
}

void choose_kernels() {
  const char* best = best_kernels();
  const bool unrecognised = blas_kernels() == "Prescott" && std::getenv("OPENBLAS_CORETYPE") == nullptr;
  if (unrecognised && best != nullptr && gotoblas_dynamic_init != nullptr && gotoblas_dynamic_quit != nullptr) {
    setenv("OPENBLAS_CORETYPE", best, 0);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
  }
  openblas_set_num_threads(1);
}

/// OpenBLAS takes a buffer at its first use, which it keeps; before release 0.3.30 it asks for it without end where
/// there is no memory (OpenBLAS, issue 5289).
void check_memory() {
  constexpr std::size_t buffer = std::size_t{136} << 20;  // bytes; 128 MiB and what malloc adds
  void* memory = std::malloc(buffer);
  if (memory == nullptr)
    throw run_error("no memory is left for a buffer of OpenBLAS ({} MiB of address space): is there a limit on it?",
                    buffer >> 20);
  std::free(memory);
}

void take_buffer() {
  const int size = 1;
  int info = 0;
  double matrix = 1;
  dpotrf_("L", &size, &matrix, &size, &info);
}

}  // namespace

void prepare_blas() {
  [[maybe_unused]] static const bool prepared = (check_memory(), choose_kernels(), take_buffer(), true);
}

std::string blas_kernels() {
  return openblas_get_corename();
}

}  // namespace tether
