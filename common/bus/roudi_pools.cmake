# Makes common/bus/roudi_pools.hpp out of the pools of config/roudi.toml, anew whenever it changes.
set(ROUDI_CONFIG ${CMAKE_SOURCE_DIR}/config/roudi.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ROUDI_CONFIG})

file(STRINGS ${ROUDI_CONFIG} size_lines REGEX "^size *= *[0-9]+")
file(STRINGS ${ROUDI_CONFIG} count_lines REGEX "^count *= *[0-9]+")
list(LENGTH size_lines ROUDI_POOL_COUNT)
list(LENGTH count_lines counts)
if(ROUDI_POOL_COUNT EQUAL 0 OR NOT ROUDI_POOL_COUNT EQUAL counts)
  message(FATAL_ERROR "${ROUDI_CONFIG}: every [[segment.mempool]] needs one line 'size = BYTES' "
                      "and one line 'count = CHUNKS'")
endif()

set(ROUDI_POOLS "")
foreach(size_line count_line IN ZIP_LISTS size_lines count_lines)
  string(REGEX MATCH "[0-9]+" bytes "${size_line}")
  string(REGEX MATCH "[0-9]+" chunks "${count_line}")
  string(APPEND ROUDI_POOLS "{${bytes}, ${chunks}}, ")
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/roudi_pools.hpp.in
               ${CMAKE_BINARY_DIR}/generated/common/bus/roudi_pools.hpp @ONLY)
