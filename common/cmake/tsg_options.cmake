# What every target of ours is compiled with, and the switches of the presets.
set(TSG_SANITIZE "" CACHE STRING "Sanitizers for all targets, e.g. address,undefined or thread")
set(TSG_SHARED_DIR "${CMAKE_SOURCE_DIR}/../shared" CACHE PATH
    "Recorded sequences and models for tests; tests that need it skip where it is absent")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  if(TSG_SANITIZE)  # else it does not cache what uses precompiled headers
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  endif()
endif()

# The instructions that every x86-64 processor since 2009 has: rounding and counting of bits are
# one each. Others have theirs by default.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(TSG_VECTOR_FLAGS -msse4.2 -mpopcnt)
endif()

add_library(tsg_options INTERFACE)
target_compile_options(tsg_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
# gcc 12 sees overlaps in "literal" + std::string where none are, at -O3 (gcc bug 105651).
target_compile_options(tsg_options INTERFACE -Wno-restrict)
target_include_directories(tsg_options INTERFACE ${CMAKE_SOURCE_DIR})

# Of what is not worth the compiler's time: command lines, which are read once, and tests that start
# processes. Sanitizers make the optimiser slower still.
set(TSG_QUICK_OPTIMISATION -O1)
if(TSG_SANITIZE)
  set(TSG_QUICK_OPTIMISATION -O0)
endif()

# For whoever builds all tests from nothing, as CI does; clang-tidy wants it off.
option(TSG_UNITY_TESTS "Compile the sources of a test 16 at a time, which takes half the time" OFF)

# In the presets with sanitizers the sources of a target are compiled 16 at a time: parsing headers
# takes longer than all else there. g++ takes sources that are included for headers, and warns of
# types that other sources do not know.
if(CMAKE_UNITY_BUILD)
  target_compile_options(tsg_options INTERFACE -Wno-subobject-linkage)
endif()

# With it and precompiled headers g++ 12 sees bounds of a moved std::string exceeded where none are.
if(TSG_SANITIZE STREQUAL "thread")
  target_compile_options(tsg_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow)
endif()

if(TSG_SANITIZE)
  add_compile_options(-fsanitize=${TSG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TSG_SANITIZE})
  # Precompiled headers serve all targets only where all have the same instructions.
  add_compile_options(${TSG_VECTOR_FLAGS})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)  # ccache needs it
endif()
