# croon_add_version(<target> TEMPLATE <file> STAGE_FOLDERS <folder>... COMMIT_ARGUMENTS <-D...>...)
#
# Adds a static library that defines the functions of experiments/store/version.hpp. The commits are those at
# each build; only this library depends on them.
function(croon_add_version target)
  cmake_parse_arguments(PARSE_ARGV 1 version "" "TEMPLATE" "STAGE_FOLDERS;COMMIT_ARGUMENTS")
  list(JOIN version_STAGE_FOLDERS "|" stage_folders)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/version.cpp")
  add_custom_target(${target}_source ALL COMMAND "${CMAKE_COMMAND}" "-DINPUT=${version_TEMPLATE}" "-DOUTPUT=${output}"
    "-DSTAGE_FOLDERS=${stage_folders}" ${version_COMMIT_ARGUMENTS} -P "${CROON_CMAKE_FOLDER}/write_version.cmake"
    BYPRODUCTS "${output}" VERBATIM)
  add_library(${target} STATIC "${output}")
  add_dependencies(${target} ${target}_source)
endfunction()
