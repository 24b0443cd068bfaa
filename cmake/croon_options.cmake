# Language, warnings and output folders; included once by the root CMakeLists.txt.
include(GNUInstallDirs)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

# For flags with paths relative to the build folder, which CMake's own checks would not find.
set(CROON_COMPILE_OPTIONS "" CACHE STRING "Compile options of all sources")
add_compile_options(${CROON_COMPILE_OPTIONS})

# Results are the same bits with any compiler: no fused multiply-adds, which only some compilers generate.
add_compile_options(-ffp-contract=off)

add_library(croon_warnings INTERFACE)
target_compile_options(croon_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC takes the sources that a unity build includes for headers, and warns of their local types.
  target_compile_options(croon_warnings INTERFACE -Wno-subobject-linkage)
endif()
if(CROON_WARNINGS_AS_ERRORS)
  target_compile_options(croon_warnings INTERFACE -Werror)
endif()
