# How every target of the project is built: warnings as errors, one BLAS thread's worth of code, tests with labels.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(nlohmann_json REQUIRED)
find_program(CCACHE ccache)
if(CCACHE)  # its results are shared by all clones
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_C_COMPILER_LAUNCHER})
endif()

add_library(tether_flags INTERFACE)
target_compile_features(tether_flags INTERFACE cxx_std_20)
target_include_directories(tether_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(tether_flags INTERFACE Eigen3::Eigen fmt::fmt)
target_compile_options(tether_flags INTERFACE -Wall -Wextra -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC 12 reports wrongly: array-bounds in Eigen under AVX, stringop-overflow in fmt::join, restrict in string + string (PR 105651),
  # and under the sanitizers maybe-uninitialized in std::regex (PR 105562).
  target_compile_options(tether_flags INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict
    $<$<CONFIG:Debug>:-Wno-maybe-uninitialized>)
endif()
target_compile_options(tether_flags INTERFACE -fPIC)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # a large translation unit needs memory anyway: collecting garbage takes a tenth of the time
  target_compile_options(tether_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
endif()
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

# tether_library(NAME [JSON] [LIGHT] SOURCES ... LIBRARIES ...): one room's library, built with the project's flags. JSON: some of its
# sources read or write it. LIGHT: no time is spent in it when programs run; less optimised it compiles in two thirds of the time.
# Several sources make one translation unit, so that what they all include is parsed once.
function(tether_light name)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${name} PRIVATE -O1)
  endif()
endfunction()
function(tether_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "JSON;LIGHT" "" "SOURCES;LIBRARIES")
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC tether_flags ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${TETHER_UNITY} UNITY_BUILD_BATCH_SIZE ${TETHER_UNITY_BATCH})
  if(arg_LIGHT)
    tether_light(${name})
  endif()
  if(arg_JSON)
    target_link_libraries(${name} PRIVATE nlohmann_json::nlohmann_json)
  endif()
endfunction()

# Under the sanitizers what draws thousands of samples takes ten times as long.
set(TETHER_PATIENCE 1)
if(CMAKE_BUILD_TYPE STREQUAL Debug)
  set(TETHER_PATIENCE 10)
endif()

# tether_test(NAME LABEL unit|contract|convergence|scenario SOURCES ... LIBRARIES ...): one CTest entry. All entries of a folder share one
# GoogleTest program, FOLDER_tests, whose sources are compiled together; an entry runs the tests that stand in its own sources.
# DEFINITIONS and NEEDS (targets that must be built) are the program's.
function(tether_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES;DEFINITIONS;NEEDS")
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(program ${folder}_tests)
  if(NOT TARGET ${program})
    add_executable(${program})
    tether_light(${program})
    set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests
      UNITY_BUILD ${TETHER_UNITY} UNITY_BUILD_BATCH_SIZE ${TETHER_UNITY_BATCH})
  endif()
  target_sources(${program} PRIVATE ${arg_SOURCES})
  target_link_libraries(${program} PRIVATE tether_flags tether_test_main nlohmann_json::nlohmann_json ${arg_LIBRARIES})
  target_compile_definitions(${program} PRIVATE ${arg_DEFINITIONS})
  if(arg_NEEDS)
    add_dependencies(${program} ${arg_NEEDS})
  endif()
  list(FILTER arg_SOURCES INCLUDE REGEX "_test[.]cpp$")  # not what they share
  add_test(NAME ${name} COMMAND ${program} ${arg_SOURCES} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(NOT arg_TIMEOUT)  # for what hangs: no busy machine needs as long
    set(arg_TIMEOUT 1800)
  endif()
  math(EXPR arg_TIMEOUT "${TETHER_PATIENCE} * ${arg_TIMEOUT}")
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABEL}" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
endfunction()
