#pragma once

#include <string>

namespace tether {

/// One BLAS thread, kernels that fit the processor, and its buffer. To be called before the first use of BLAS; further
/// calls do nothing. Throws RunError if there is no memory for the buffer.
///
/// OpenBLAS knows processors by their numbers. One that is newer than the library gets kernels of 2004 (SSE3), which
/// factor a matrix at half the speed; it is then told to use those for AVX-512 or AVX2. Environment variables would not
/// do: the library reads them before main.
void prepare_blas();

/// Name of the kernels in use, such as "SkylakeX".
std::string blas_kernels();

}  // namespace tether
