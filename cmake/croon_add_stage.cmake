# croon_add_stage(<kind> <name> [SOURCE <file>] [NEEDS <target>...])
#
# Adds the stage that <kind>/<name>.cpp (or <file>) defines: compiles the file and adds one call of
# croon::stages::<kind>::<name>() to the registry's list. If a target that it needs does not exist (an
# option turned its library off), the stage is left out and the configuration prints a line.
# It sees the headers of framework, of what it needs, and of the folder that adds it.
#
# In a unity build a source includes one stage of every kind, because most of the time of compiling a stage goes into headers.
# Stages of one kind use one name for many things, so they cannot be one source. A stage that needs a target is alone: its
# options, or the target itself, must not reach others.
#
# The same in this tree and after find_package(croon); there, croon_add_program makes the program.
function(croon_add_stage kind name)
  cmake_parse_arguments(PARSE_ARGV 2 stage "" "SOURCE" "NEEDS")
  set_property(DIRECTORY APPEND PROPERTY croon_stages "${kind}/${name}")
  foreach(target IN LISTS stage_NEEDS)
    if(NOT TARGET ${target})
      message(STATUS "croon: stage ${kind}/${name} is left out (no ${target})")
      return()
    endif()
  endforeach()
  if(NOT stage_SOURCE)
    set(stage_SOURCE "${kind}/${name}.cpp")
  endif()
  set(library croon_stage_${kind}_${name})
  if(CMAKE_UNITY_BUILD AND NOT stage_NEEDS)
    # The first stage of each kind in this folder is in the first source, and so on. Folders do not share sources.
    get_property(earlier DIRECTORY PROPERTY croon_stages_of_${kind})
    list(LENGTH earlier number)
    set_property(DIRECTORY APPEND PROPERTY croon_stages_of_${kind} ${name})
    file(RELATIVE_PATH folder "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
    string(MAKE_C_IDENTIFIER "stages_in_${folder}_${number}" source)
    set(library croon_${source})
  endif()
  if(TARGET ${library})
    target_sources(${library} PRIVATE "${stage_SOURCE}")
  else()
    add_library(${library} OBJECT "${stage_SOURCE}")
    set_target_properties(${library} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
    set_property(GLOBAL APPEND PROPERTY CROON_STAGE_LIBRARIES ${library})
  endif()
  # For the header of a kind of stage that comes with the folder.
  target_include_directories(${library} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
  target_link_libraries(${library} PRIVATE croon::framework ${stage_NEEDS})
  if(TARGET croon_warnings)
    target_link_libraries(${library} PRIVATE croon_warnings)
  else()
    # As in the tree: the same bits with any compiler.
    target_compile_options(${library} PRIVATE -ffp-contract=off)
  endif()
  set_property(GLOBAL APPEND PROPERTY CROON_STAGES "${kind}/${name}")
  set_property(GLOBAL APPEND PROPERTY CROON_STAGE_NEEDS ${stage_NEEDS})
endfunction()

# croon_add_stages(): adds every <kind>/<name>.cpp of the folder that croon_add_stage has not been called for. Not for the
# root of a project, where <kind> may be a build folder.
function(croon_add_stages)
  get_property(added DIRECTORY PROPERTY croon_stages)
  file(GLOB sources RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp")
  foreach(source IN LISTS sources)
    string(REGEX REPLACE "\\.cpp$" "" stage "${source}")
    if(NOT stage IN_LIST added)
      string(REPLACE "/" ";" kind_and_name "${stage}")
      croon_add_stage(${kind_and_name})
    endif()
  endforeach()
endfunction()

# croon_write_stage_list(<file> <kind>/<name>...): writes the definition of registry() with these stages.
function(croon_write_stage_list file)
  set(declarations "")
  set(calls "")
  foreach(stage IN LISTS ARGN)
    string(REPLACE "/" ";" parts "${stage}")
    list(GET parts 0 kind)
    list(GET parts 1 name)
    string(APPEND declarations "namespace stages::${kind} {\nStageEntry ${name}();\n}\n")
    string(APPEND calls "    all.add(stages::${kind}::${name}());\n")
  endforeach()
  configure_file("${CROON_CMAKE_FOLDER}/stage_list.cpp.in" "${file}" @ONLY)
endfunction()
