# Headers that most sources include, parsed once for all targets and not once per source: some 2 s
# of each. Only with sanitizers: the other presets see to it that each source includes what it uses,
# and give clang-tidy the commands to read.
set(TSG_PRECOMPILED_HEADERS
    <algorithm> <chrono> <condition_variable> <filesystem> <fstream> <functional> <iostream> <map>
    <memory> <numeric> <optional> <random> <span> <sstream> <string> <thread> <unordered_map>
    <vector> <tl/expected.hpp> <Eigen/Core> <Eigen/Geometry> <opencv2/core.hpp>
    <opencv2/imgproc.hpp>)

# One set for libraries and services, one for unit tests, one for tests that are compiled quickly; g++
# takes one per source.
function(tsg_precompile_headers)
  if(NOT TSG_SANITIZE)
    return()
  endif()
  tsg_precompiled_set(tsg_pch LINK Eigen3::Eigen opencv_core tl::expected
                      HEADERS ${TSG_PRECOMPILED_HEADERS})
  tsg_precompiled_set(tsg_test_pch LINK Eigen3::Eigen opencv_core tl::expected
                                        GTest::gtest GTest::gmock
                      HEADERS ${TSG_PRECOMPILED_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
  tsg_precompiled_set(tsg_quick_test_pch LINK Eigen3::Eigen opencv_core tl::expected
                                              GTest::gtest GTest::gmock
                                              nlohmann_json::nlohmann_json
                      HEADERS ${TSG_PRECOMPILED_HEADERS} <gmock/gmock.h> <gtest/gtest.h>
                              <nlohmann/json.hpp>)
  target_compile_options(tsg_quick_test_pch PRIVATE ${TSG_QUICK_OPTIMISATION})
endfunction()

# CMake wants a source where there are precompiled headers: an empty one.
function(tsg_precompiled_set name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LINK} tsg_options)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# tsg_use_precompiled(TARGET SET): a target whose flags differ from the set's in -m or -O does not
# build, as the compiler warns (-Winvalid-pch); such a target sets DISABLE_PRECOMPILE_HEADERS.
function(tsg_use_precompiled target set)
  if(TSG_SANITIZE)
    target_precompile_headers(${target} REUSE_FROM ${set})
  endif()
endfunction()
