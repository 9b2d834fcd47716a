# How every target of the project is built: warnings as errors, one BLAS thread's worth of code, tests with labels.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(tether_flags INTERFACE)
target_compile_features(tether_flags INTERFACE cxx_std_20)
target_include_directories(tether_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(tether_flags INTERFACE Eigen3::Eigen fmt::fmt)
# GCC 12 reports wrongly: array-bounds in Eigen under AVX, stringop-overflow in fmt::join, restrict in string + string (PR 105651).
target_compile_options(tether_flags INTERFACE -Wall -Wextra -Werror -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
target_compile_definitions(tether_flags INTERFACE OMPI_SKIP_MPICXX)
if(TETHER_NATIVE)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_FLAGS -march=x86-64-v3)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }"
                        TETHER_HAS_X86_64_V3)
  unset(CMAKE_REQUIRED_FLAGS)
  if(TETHER_HAS_X86_64_V3)
    target_compile_options(tether_flags INTERFACE -march=x86-64-v3)
  endif()
endif()

# tether_library(NAME SOURCES ... LIBRARIES ...): one room's library, built with the project's flags.
function(tether_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC tether_flags ${arg_LIBRARIES})
endfunction()

# tether_test(NAME LABEL unit|contract|convergence|scenario SOURCES ... LIBRARIES ...): one GoogleTest program, one CTest entry.
function(tether_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES")
  find_package(GTest REQUIRED)
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE tether_flags GTest::gtest_main ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABEL}" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
endfunction()
