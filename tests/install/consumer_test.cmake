# Installs the build into an empty folder, looks for what must be there, then configures, builds and runs the consumer.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} failed with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

string(REPLACE "," ";" places "${PLACES}")
list(GET places 0 bin)
list(GET places 1 lib)
list(GET places 2 include)
list(GET places 3 data)
list(GET places 4 man)
foreach(file IN ITEMS ${bin}/raytrace ${lib}/libraytrace.a ${lib}/raytrace/raytrace_openimageio.so
    ${lib}/cmake/raytrace/raytraceConfig.cmake
    ${include}/raytrace/render/renderer.h ${data}/raytrace/scenes/seed.xml ${data}/raytrace/scenes/raytracer.xsd
    ${data}/raytrace/statistics.schema.json ${data}/raytrace/openjd/tiles.yaml ${data}/raytrace/slurm/tiles.sbatch
    ${man}/man1/raytrace.1 ${man}/man1/raytrace-merge.1)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
run(${prefix}/${bin}/raytrace --version)

set(flags "")
if(SANITIZERS)
  set(flags -fsanitize=${SANITIZERS})
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${SCRATCH}/build -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_CXX_FLAGS=${flags}
  -D RAYTRACE_LEAST_VERSION=${VERSION})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
# A JPEG, so that the module is found. (The dlopen of sanitizers overlooks run paths.)
set(picture ${SCRATCH}/seed.jpg)
if(SANITIZERS)
  set(picture ${SCRATCH}/seed.exr)
endif()
run(${SCRATCH}/build/consumer ${prefix}/${data}/raytrace/scenes/seed.xml ${picture})
if(NOT EXISTS ${picture})
  message(FATAL_ERROR "the consumer wrote no picture:\n${output}")
endif()
