# cmake -D ROOT=tree -P include_rules.cmake: fails, and names every offender, unless
#   only lib/raytrace/accel/ includes Embree,
#   only lib/raytrace/xml/ includes tinyxml2,
#   only lib/raytrace/display/display_server.cpp includes Asio,
#   only gltf_draco.cpp and gltf_meshopt.cpp, and their tests, include Draco and meshoptimizer,
#   only lib/raytrace/math/simd.h and twin_batch.h include intrinsics or the SIMD library.

file(GLOB_RECURSE files RELATIVE ${ROOT}
  ${ROOT}/lib/*.h ${ROOT}/lib/*.cpp ${ROOT}/apps/*.h ${ROOT}/apps/*.cpp
  ${ROOT}/tests/*.h ${ROOT}/tests/*.cpp ${ROOT}/benchmarks/*.h ${ROOT}/benchmarks/*.cpp)
if(NOT files)
  message(FATAL_ERROR "no sources under ${ROOT}")
endif()

set(offenders "")
function(only place included)
  foreach(file IN LISTS files)
    if(file MATCHES "^${place}")
      continue()
    endif()
    file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]${included}")
    foreach(line IN LISTS lines)
      string(APPEND offenders "  ${file}: ${line} (only in ${place})\n")
    endforeach()
  endforeach()
  set(offenders "${offenders}" PARENT_SCOPE)
endfunction()

only("lib/raytrace/accel/" "embree[0-9]*/")
only("lib/raytrace/xml/" "tinyxml2")
only("lib/raytrace/display/display_server[.]cpp$" "asio[./]")
only("(lib/raytrace|tests)/import/gltf_draco(_test)?[.]cpp$" "draco/")
only("(lib/raytrace|tests)/import/gltf_meshopt(_test)?[.]cpp$" "meshoptimizer[.]h")
only("lib/raytrace/math/(simd|twin_batch)[.]h$" "([a-z0-9]*intrin[.]h|arm_(neon|sve)[.]h|xsimd/)")

if(offenders)
  message(FATAL_ERROR "includes in the wrong place:\n${offenders}")
endif()
