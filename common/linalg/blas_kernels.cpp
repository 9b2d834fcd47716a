#include "common/linalg/blas_kernels.hpp"

#include <cstdlib>

extern "C" {
void openblas_set_num_threads(int);
char* openblas_get_corename();
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

bool choose_kernels() {
  const char* best = best_kernels();
  const bool unrecognised = blas_kernels() == "Prescott" && std::getenv("OPENBLAS_CORETYPE") == nullptr;
  if (unrecognised && best != nullptr && gotoblas_dynamic_init != nullptr && gotoblas_dynamic_quit != nullptr) {
    setenv("OPENBLAS_CORETYPE", best, 0);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
  }
  openblas_set_num_threads(1);
  return true;
}

}  // namespace

void prepare_blas() {
  [[maybe_unused]] static const bool chosen = choose_kernels();
}

std::string blas_kernels() {
  return openblas_get_corename();
}

}  // namespace tether
