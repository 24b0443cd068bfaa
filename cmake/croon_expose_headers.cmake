# croon_expose_headers(<target> <folder>...)
#
# Those who link the target see the headers below these folders of the tree, and no others: their
# include path is a folder of the build with a link to each of them. So a layer cannot include what
# it does not link.
function(croon_expose_headers target)
  set(include_folder "${PROJECT_BINARY_DIR}/include/${target}")
  foreach(folder IN LISTS ARGN)
    get_filename_component(parent "${include_folder}/${folder}" DIRECTORY)
    file(MAKE_DIRECTORY "${parent}")
    file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}" "${include_folder}/${folder}" SYMBOLIC)
  endforeach()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    target_include_directories(${target} INTERFACE "${include_folder}")
  else()
    target_include_directories(${target} PUBLIC "${include_folder}")
  endif()
endfunction()
