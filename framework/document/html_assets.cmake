# Embeds the style sheet and the scripts of HTML reports; empty strings if CROON_WITH_REPORT is off.
if(CROON_WITH_REPORT)
  find_file(CROON_THREE_JS three.min.js PATHS /usr/share/javascript/three /usr/share/nodejs/three/build
    DOC "The UMD build of three.js (Debian and Ubuntu: libjs-three)" NO_DEFAULT_PATH)
  if(NOT CROON_THREE_JS)
    message(FATAL_ERROR "Expected three.min.js for reports (package libjs-three), found none; "
      "set CROON_THREE_JS to its path, or build without reports: -DCROON_WITH_REPORT=OFF")
  endif()
endif()
foreach(asset IN ITEMS "report_style|document/assets/report.css" "three_script|${CROON_THREE_JS}"
    "cloud_view_script|document/assets/cloud_view.js" "report_script|document/assets/report.js")
  string(REPLACE "|" ";" asset "${asset}")
  list(GET asset 0 name)
  list(GET asset 1 path)
  set(${name} "")
  if(CROON_WITH_REPORT)
    get_filename_component(path "${path}" ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
    file(READ "${path}" ${name})
  endif()
endforeach()
if(CROON_WITH_REPORT)
  # The minified file has no notice, and reports are copies of it.
  file(READ document/assets/three_license.txt three_license)
  string(PREPEND three_script "/*\n${three_license}*/\n")
endif()
configure_file(document/html_assets.cpp.in html_assets.cpp @ONLY)
# The compiler limits are those of the standard otherwise.
set_source_files_properties("${CMAKE_CURRENT_BINARY_DIR}/html_assets.cpp" PROPERTIES
  COMPILE_OPTIONS -Wno-overlength-strings SKIP_UNITY_BUILD_INCLUSION ON)
