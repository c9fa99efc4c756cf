# The one list of what the project needs, each with its least version. The packages of Debian and Ubuntu that bring
# them stand in cmake/setup.sh.
include(FetchContent)

# find_package with a version refuses the next major version of many packages; here the least version is all that counts.
macro(raytrace_require package least_version)
  find_package(${package} CONFIG REQUIRED ${ARGN})
  if(${package}_VERSION VERSION_LESS ${least_version})
    message(FATAL_ERROR "${package} ${${package}_VERSION} is too old: at least ${least_version} is needed")
  endif()
endmacro()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

# Embree 4 where there is one; the bridge between the two is lib/raytrace/accel/embree.h.
find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 CONFIG REQUIRED)
endif()

# Debian's Imath, which both of these look for, tells at length that its Python module is not installed.
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
raytrace_require(OpenImageIO 2.4)
raytrace_require(OpenEXR 3.1)
unset(CMAKE_MESSAGE_LOG_LEVEL)
find_package(PNG 1.6 REQUIRED)
find_package(JPEG 62 REQUIRED) # libjpeg-turbo 2.1: jpeg_reader.cpp checks that it is that library
find_package(ZLIB 1.2.11 REQUIRED)
raytrace_require(TBB 2021)
raytrace_require(xsimd 8.1)
raytrace_require(CLI11 2.1)
raytrace_require(nlohmann_json 3.11)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash>=0.8.1)
pkg_check_modules(webp REQUIRED IMPORTED_TARGET libwebp>=1.2)
include(cmake/package_faults.cmake)

# What decodes compressed glTF files, where it is installed. Without one, such files are refused by an error that names it.
set(raytrace_codec_packages "")
set(raytrace_codec_targets "")
set(raytrace_codec_definitions "") # which of them the sources have
macro(raytrace_codec package least_version target definition extension)
  find_package(${package} CONFIG QUIET)
  if(${package}_FOUND AND NOT ${package}_VERSION VERSION_LESS ${least_version})
    list(APPEND raytrace_codec_packages ${package})
    list(APPEND raytrace_codec_targets ${target})
    list(APPEND raytrace_codec_definitions ${definition})
  else()
    message(STATUS "${package} ${least_version} or later is not installed: glTF files with ${extension} will be refused")
  endif()
endmacro()
raytrace_codec(draco 1.5.5 draco::draco RAYTRACE_DRACO KHR_draco_mesh_compression)
raytrace_codec(meshoptimizer 0.18 meshoptimizer::meshoptimizer RAYTRACE_MESHOPTIMIZER EXT_meshopt_compression)

# What converts models of other formats, in a program of its own. Without it, such files are refused by an error that names it.
find_package(assimp CONFIG QUIET)
if(assimp_FOUND AND assimp_VERSION VERSION_LESS 5.2)
  set(assimp_FOUND OFF)
endif()
if(assimp_FOUND)
  list(APPEND raytrace_codec_definitions RAYTRACE_ASSIMP) # for tests: nothing in the library knows of it
else()
  message(STATUS "assimp 5.2 or later is not installed: .fbx, .dae and other models will be refused")
endif()

# Standalone Asio: headers alone, and no CMake files in Debian's package.
find_path(ASIO_INCLUDE_DIR asio.hpp REQUIRED)
mark_as_advanced(ASIO_INCLUDE_DIR)
file(STRINGS ${ASIO_INCLUDE_DIR}/asio/version.hpp asio_version REGEX "^#define ASIO_VERSION [0-9]+")
string(REGEX MATCH "[0-9]+" asio_version "${asio_version}")
if(asio_version LESS 102200)
  message(FATAL_ERROR "Asio in ${ASIO_INCLUDE_DIR} is too old: at least 1.22 is needed")
endif()
add_library(asio INTERFACE IMPORTED)
target_include_directories(asio INTERFACE ${ASIO_INCLUDE_DIR})
target_compile_definitions(asio INTERFACE ASIO_STANDALONE ASIO_NO_DEPRECATED)

FetchContent_Declare(tinyxml2
  GIT_REPOSITORY https://github.com/leethomason/tinyxml2.git
  GIT_TAG 9148bdf719e997d1f474be6bcc7943881046dba1 # 11.0.0
  FIND_PACKAGE_ARGS CONFIG)
FetchContent_MakeAvailable(tinyxml2)

if(RAYTRACE_TESTS)
  FetchContent_Declare(Catch2
    GIT_REPOSITORY https://github.com/catchorg/Catch2.git
    GIT_TAG fa43b77429ba76c462b1898d6cd2f2d7a9416b14 # 3.7.1
    FIND_PACKAGE_ARGS CONFIG)
  FetchContent_MakeAvailable(Catch2)
  if(Catch2_FOUND AND Catch2_VERSION VERSION_LESS 2.13)
    message(FATAL_ERROR "Catch2 ${Catch2_VERSION} is too old: at least 2.13 is needed")
  endif()
  # Where catch_discover_tests is: beside the installed package, or in the fetched source.
  list(APPEND CMAKE_MODULE_PATH ${Catch2_DIR} ${catch2_SOURCE_DIR}/extras)
endif()

if(RAYTRACE_BENCHMARKS)
  find_package(benchmark 1.6 CONFIG QUIET)
  if(NOT benchmark_FOUND)
    message(STATUS "Google Benchmark 1.6 or later is not installed: raytrace_micro_benchmark is left out")
  endif()
endif()
