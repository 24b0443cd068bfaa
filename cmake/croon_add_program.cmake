# croon_add_program(<name>)
#
# Adds croon's program under this name, with the stages of the installed croon and those of the calls of
# croon_add_stage before. For a project that has found the package with COMPONENTS program.
function(croon_add_program name)
  get_property(stages GLOBAL PROPERTY CROON_STAGES)
  get_property(libraries GLOBAL PROPERTY CROON_STAGE_LIBRARIES)
  get_property(needs GLOBAL PROPERTY CROON_STAGE_NEEDS)
  croon_write_stage_list("${CMAKE_CURRENT_BINARY_DIR}/${name}_stages.cpp" ${CROON_TREE_STAGES} ${stages})
  croon_add_version(${name}_version TEMPLATE "${CROON_CMAKE_FOLDER}/version.cpp.in"
    STAGE_FOLDERS "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMIT_ARGUMENTS "-DCOMMIT_INPUT=${CROON_CMAKE_FOLDER}/croon_commit.cmake")
  target_link_libraries(${name}_version PRIVATE croon::framework)
  set(objects "")
  foreach(library IN LISTS libraries)
    list(APPEND objects "$<TARGET_OBJECTS:${library}>")
  endforeach()
  add_executable(${name} "${CMAKE_CURRENT_BINARY_DIR}/${name}_stages.cpp" ${objects})
  target_link_libraries(${name} PRIVATE croon::program croon::cli croon::registry croon::stages croon::simulation
    croon::framework ${name}_version)
  foreach(need IN LISTS needs)
    target_link_libraries(${name} PRIVATE "$<LINK_ONLY:${need}>")
  endforeach()
endfunction()
