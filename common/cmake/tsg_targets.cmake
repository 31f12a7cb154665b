# The few shapes of target that this project has.

# tsg_library(NAME SOURCES a.cpp ... LINK target ...): a static library.
function(tsg_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE tsg_options)
    target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
    tsg_use_precompiled(${name} tsg_pch)
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARG_LINK})
    target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
  endif()
endfunction()

# tsg_pure_library(...): a library of a service or of maths, which may use neither the bus nor the
# process frame. The check runs over the whole link graph once all targets are known.
function(tsg_pure_library name)
  tsg_library(${name} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY TSG_PURE_LIBRARIES ${name})
endfunction()

# tsg_service(NAME SOURCES ... LINK ...): an executable.
function(tsg_service name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} tsg_options)
  target_compile_definitions(${name} PRIVATE TSG_VERSION="${PROJECT_VERSION}")
  tsg_use_precompiled(${name} tsg_pch)
endfunction()

# tsg_unit_test(NAME [THREADED] SOURCES ... LINK ...): tests without bus; run anywhere, at once.
# Only THREADED ones are built with the thread sanitizer: in the others it has nothing to find.
function(tsg_unit_test name)
  cmake_parse_arguments(ARG "THREADED" "" "SOURCES;LINK" ${ARGN})
  tsg_add_test_executable(${name} "${ARG_SOURCES}" "${ARG_LINK}")
  if(TSG_SANITIZE STREQUAL "thread" AND NOT ARG_THREADED)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  gtest_discover_tests(${name} PROPERTIES LABELS unit DISCOVERY_TIMEOUT 60)
endfunction()

# tsg_component_test(NAME SOURCES ... LINK ... [LABEL e2e]): real processes on a real bus. Runs on
# a host of its own (private /dev/shm, RouDi socket and loopback), so that tests never meet.
function(tsg_component_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL component)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
    if(TSG_SANITIZE)
      set(ARG_TIMEOUT 300)
    endif()
  endif()
  tsg_add_test_executable(${name} "${ARG_SOURCES}" "${ARG_LINK}" QUICK)
  target_compile_definitions(${name} PRIVATE TSG_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}"
                                             TSG_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_test(NAME ${name}
           COMMAND ${CMAKE_SOURCE_DIR}/tests/support/own_host $<TARGET_FILE:${name}>)
  set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT})
endfunction()

# tsg_add_test_executable(NAME SOURCES LINK [QUICK]): QUICK where what takes time is in others.
function(tsg_add_test_executable name sources link)
  cmake_parse_arguments(ARG "QUICK" "" "" ${ARGN})
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${link} tsg_options GTest::gtest GTest::gmock
                                        GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE TSG_DEFAULT_SHARED_DIR="${TSG_SHARED_DIR}")
  if(TSG_UNITY_TESTS)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    target_compile_options(${name} PRIVATE -Wno-subobject-linkage)  # g++ takes them for headers
  endif()
  if(ARG_QUICK)
    target_compile_options(${name} PRIVATE ${TSG_QUICK_OPTIMISATION})
    tsg_use_precompiled(${name} tsg_quick_test_pch)
  else()
    tsg_use_precompiled(${name} tsg_test_pch)
  endif()
endfunction()

# Collects everything `target` links to, directly or not.
function(tsg_collect_links target result)
  set(seen ${${result}})
  foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
    get_target_property(links ${target} ${property})
    foreach(link IN LISTS links)
      string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" link "${link}")
      if(TARGET "${link}" AND NOT link IN_LIST seen)
        list(APPEND seen ${link})
        tsg_collect_links(${link} seen)
      endif()
    endforeach()
  endforeach()
  set(${result} ${seen} PARENT_SCOPE)
endfunction()

# Stops the configuration where a pure library reaches the bus, the process frame or the logger.
function(tsg_check_dependency_direction)
  get_property(libraries GLOBAL PROPERTY TSG_PURE_LIBRARIES)
  foreach(library IN LISTS libraries)
    set(links "")
    tsg_collect_links(${library} links)
    foreach(forbidden bus bus_messages app CycloneDDS::ddsc)
      if(forbidden IN_LIST links)
        message(FATAL_ERROR "${library} is a pure library, yet it links to ${forbidden} "
                            "(docs/architecture.md, dependency direction)")
      endif()
    endforeach()
  endforeach()
endfunction()

# tsg_vectorise(NAME): with all instructions that processors in use have.
function(tsg_vectorise name)
  target_compile_options(${name} PUBLIC ${TSG_VECTOR_FLAGS})
endfunction()

# tsg_compile_quickly(NAME ...): for command lines. With CLI11 they take the compiler longest of all
# files, most of it to optimise (10 s to 7 s each at -O1; with the address sanitizer 15 s to 10 s at
# -O0).
function(tsg_compile_quickly)
  foreach(name IN LISTS ARGN)
    target_compile_options(${name} PRIVATE ${TSG_QUICK_OPTIMISATION})
    set_target_properties(${name} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
