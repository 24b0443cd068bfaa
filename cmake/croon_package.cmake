# `cpack` in a build with CROON_WITH_PYTHON makes a .deb for the release of Debian or Ubuntu that it runs on: the component
# `runtime`, which has the program, the Python package, the experiments and the examples.
cmake_host_system_information(RESULT distribution QUERY DISTRIB_ID)
cmake_host_system_information(RESULT release QUERY DISTRIB_VERSION_ID)

# Two ground extractors use parts of CGAL that are GPL.
set(CROON_BINARY_LICENSE "Apache-2.0")
set(CROON_BINARY_REASON "")
if(CROON_WITH_CGAL)
  set(CROON_BINARY_LICENSE "GPL-3.0+")
  set(CROON_BINARY_REASON " The program contains parts of CGAL that are under the GPL, so these binaries as a whole are under the
 GPL, version 3 or later: /usr/share/common-licenses/GPL-3. The sources of croon itself are under the Apache License 2.0.
 A build with -DCROON_WITH_CGAL=OFF has no such parts.")
endif()
set(CROON_THREE_COPYRIGHT "")
if(CROON_WITH_REPORT)
  file(READ framework/document/assets/three_license.txt CROON_THREE_COPYRIGHT)
  string(REPLACE "\n\n" "\n.\n" CROON_THREE_COPYRIGHT "${CROON_THREE_COPYRIGHT}")
  string(REGEX REPLACE "\n(.)" "\n \\1" CROON_THREE_COPYRIGHT "${CROON_THREE_COPYRIGHT}")
  string(PREPEND CROON_THREE_COPYRIGHT
    "\nFiles: three.min.js\nCopyright: 2010-2017 three.js authors\nComment: embedded in the program and in reports\nLicense: Expat\n ")
endif()
configure_file(cmake/copyright.in "${CMAKE_CURRENT_BINARY_DIR}/copyright" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/croon" COMPONENT runtime)
install(DIRECTORY docs/examples DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/croon" COMPONENT runtime)

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_NAME croon)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "calibration of a vehicle's LiDARs to each other")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Finds the poses of LiDARs from ordinary recordings, without targets and without an initial
guess, and says which of them can be trusted. With a Python module and experiments.")
set(CPACK_PACKAGE_CONTACT "the authors of croon <croon@localhost>")
set(CPACK_STRIP_FILES ON)
# The program and the Python package alone; no libraries and headers.
set(CPACK_COMPONENTS_ALL runtime)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~${distribution}${release}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CROON_WITH_PYTHON)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(python "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "${python}, python3-numpy")
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS python3-pandas)
endif()
include(CPack)
