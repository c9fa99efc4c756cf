# Installs the build into an empty folder, looks for what must be there, then configures, builds and runs the consumer,
# which is the program of docs/library.md.
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
list(GET places 5 doc)
foreach(file IN ITEMS ${bin}/raytrace ${lib}/libraytrace.a ${lib}/raytrace/raytrace_openimageio.so
    ${lib}/cmake/raytrace/raytraceConfig.cmake
    ${include}/raytrace/render/renderer.h ${data}/raytrace/scenes/seed.xml ${data}/raytrace/scenes/raytracer.xsd
    ${data}/raytrace/statistics.schema.json ${data}/raytrace/openjd/tiles.yaml ${data}/raytrace/slurm/tiles.sbatch
    ${include}/raytrace/raytrace.h ${man}/man1/raytrace.1 ${man}/man1/raytrace-merge.1
    ${doc}/LICENSE ${doc}/README.md ${doc}/docs/library.md ${doc}/docs/scene-format.md ${doc}/docs/images/first.png
    ${doc}/docs/images/gallery/dusk.png ${data}/bash-completion/completions/raytrace
    ${data}/zsh/site-functions/_raytrace ${data}/fish/vendor_completions.d/raytrace.fish)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
run(${prefix}/${bin}/raytrace --version)
file(READ ${CONSUMER}/main.cpp program)
file(READ ${prefix}/${doc}/docs/library.md page)
string(FIND "${page}" "${program}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "docs/library.md does not show ${CONSUMER}/main.cpp as it is")
endif()

set(flags "")
if(SANITIZERS)
  set(flags -fsanitize=${SANITIZERS})
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${SCRATCH}/build -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_CXX_FLAGS=${flags}
  -D RAYTRACE_LEAST_VERSION=${VERSION})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
# A JPEG, so that the module is found. (The dlopen of sanitizers overlooks run paths.)
set(picture ${SCRATCH}/example.jpg)
if(SANITIZERS)
  set(picture ${SCRATCH}/example.exr)
endif()
run(${SCRATCH}/build/consumer ${picture})
if(NOT EXISTS ${picture})
  message(FATAL_ERROR "the consumer wrote no picture:\n${output}")
endif()
