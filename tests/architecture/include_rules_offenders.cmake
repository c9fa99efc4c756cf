# cmake -D RULES=include_rules.cmake -D FOLDER=scratch -P include_rules_offenders.cmake: fails unless the rules name each
# of the offenders written here.
set(includes "<embree3/rtcore.h>" "\"embree4/rtcore.h\"" "<tinyxml2.h>" "<asio.hpp>" "<asio/ip/tcp.hpp>"
  "<draco/mesh/mesh.h>" "<meshoptimizer.h>" "<immintrin.h>" "<arm_neon.h>" "<xsimd/xsimd.hpp>")
file(REMOVE_RECURSE ${FOLDER})
set(number 0)
foreach(include IN LISTS includes)
  math(EXPR number "${number} + 1")
  file(WRITE ${FOLDER}/lib/raytrace/shapes/offender${number}.h "#include ${include}\n")
endforeach()

execute_process(COMMAND ${CMAKE_COMMAND} -D ROOT=${FOLDER} -P ${RULES} RESULT_VARIABLE result ERROR_VARIABLE report)
if(result EQUAL 0)
  message(FATAL_ERROR "the rules accept a tree that breaks them")
endif()
foreach(i RANGE 1 ${number})
  if(NOT report MATCHES "offender${i}[.]h")
    message(FATAL_ERROR "offender${i}.h was not found:\n${report}")
  endif()
endforeach()
