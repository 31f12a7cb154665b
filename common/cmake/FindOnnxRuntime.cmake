# Finds ONNX Runtime as deploy/install-onnxruntime or the distribution (Debian 13 and later) puts it.
#
# The library is loaded at run time, so nothing links it:
#   OnnxRuntime::headers   include directory, and TSG_ONNXRUNTIME_LIBRARY="path found at build time"
#   OnnxRuntime_VERSION    1.<API version of the headers>
# Where to look first: the environment's or CMake's TSG_ONNXRUNTIME_DIR.
set(_onnxruntime_hints ${TSG_ONNXRUNTIME_DIR} $ENV{TSG_ONNXRUNTIME_DIR} /opt/tsg-slam/onnxruntime
                       $ENV{HOME}/.local/share/tsg-slam/onnxruntime)

find_path(OnnxRuntime_INCLUDE_DIR onnxruntime_cxx_api.h
          HINTS ${_onnxruntime_hints} PATH_SUFFIXES include onnxruntime onnxruntime/core/session)
find_file(OnnxRuntime_LIBRARY NAMES libonnxruntime.so.1 libonnxruntime.so
          HINTS ${_onnxruntime_hints} /usr/lib /usr/local/lib
          PATH_SUFFIXES lib ${CMAKE_LIBRARY_ARCHITECTURE})
mark_as_advanced(OnnxRuntime_INCLUDE_DIR OnnxRuntime_LIBRARY)

if(OnnxRuntime_INCLUDE_DIR)
  file(STRINGS ${OnnxRuntime_INCLUDE_DIR}/onnxruntime_c_api.h _onnxruntime_api
       REGEX "^#define ORT_API_VERSION [0-9]+")
  string(REGEX REPLACE "[^0-9]" "" _onnxruntime_api "${_onnxruntime_api}")
  set(OnnxRuntime_VERSION 1.${_onnxruntime_api})
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OnnxRuntime
  REQUIRED_VARS OnnxRuntime_LIBRARY OnnxRuntime_INCLUDE_DIR
  VERSION_VAR OnnxRuntime_VERSION
  REASON_FAILURE_MESSAGE "Run deploy/install-deps, or deploy/install-onnxruntime for this alone.")

if(OnnxRuntime_FOUND AND NOT TARGET OnnxRuntime::headers)
  add_library(OnnxRuntime::headers INTERFACE IMPORTED)
  set_target_properties(OnnxRuntime::headers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${OnnxRuntime_INCLUDE_DIR}
    INTERFACE_COMPILE_DEFINITIONS "TSG_ONNXRUNTIME_LIBRARY=\"${OnnxRuntime_LIBRARY}\"")
endif()
