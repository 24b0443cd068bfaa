# croon_expose_headers(<target> <folder>...)
#
# Those who link the target see the headers below these folders of the tree, and no others: their
# include path is a folder of the build with a link to each of them. So a layer cannot include what
# it does not link. Headers are visible as <croon/...> too, as they are installed.
function(croon_expose_headers target)
  set(include_folder "${PROJECT_BINARY_DIR}/include/${target}")
  foreach(folder IN LISTS ARGN)
    string(REGEX REPLACE "^croon/framework/" "croon/" library_folder "croon/${folder}")
    foreach(path IN ITEMS "${folder}" "${library_folder}")
      get_filename_component(parent "${include_folder}/${path}" DIRECTORY)
      file(MAKE_DIRECTORY "${parent}")
      file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}" "${include_folder}/${path}" SYMBOLIC)
    endforeach()
  endforeach()
  set(folders "$<BUILD_INTERFACE:${include_folder}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/croon>")
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    target_include_directories(${target} INTERFACE ${folders})
  else()
    target_include_directories(${target} PUBLIC ${folders})
  endif()
endfunction()
