# Every library that croon uses; docs/design.md has the purpose of each.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
find_package(PNG REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-pdf)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(YAML_CPP REQUIRED IMPORTED_TARGET yaml-cpp)
pkg_check_modules(TINYXML2 REQUIRED IMPORTED_TARGET tinyxml2)
if(CROON_BUILD_TOOLS)
  find_package(CLI11 REQUIRED)
  find_package(embree REQUIRED)
  find_package(Boost REQUIRED)
  if(CROON_WITH_JEMALLOC)
    pkg_check_modules(JEMALLOC REQUIRED IMPORTED_TARGET jemalloc)
  endif()
endif()
if(CROON_WITH_PYTHON)
  # The system's, which has the packages; another one that comes first on the path may not. Give Python3_EXECUTABLE
  # for another.
  find_program(Python3_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 REQUIRED)
endif()

# Only FindOpenVDB.cmake exists, and not on the default module path.
file(GLOB openvdb_modules /usr/lib/*/cmake/OpenVDB)
list(APPEND CMAKE_MODULE_PATH ${openvdb_modules})
find_package(OpenVDB REQUIRED)

find_library(LZF_LIBRARY NAMES lzf liblzf REQUIRED)
find_library(SLEEF_LIBRARY NAMES sleef REQUIRED)
pkg_check_modules(SLEEF sleef)  # Its version.
pkg_check_modules(NETTLE REQUIRED IMPORTED_TARGET nettle)

# If CGAL is off, the target does not exist and the stages that need it are left out.
if(CROON_WITH_CGAL)
  find_package(CGAL REQUIRED)
  add_library(croon_cgal INTERFACE)
  target_link_libraries(croon_cgal INTERFACE CGAL::CGAL)
endif()
