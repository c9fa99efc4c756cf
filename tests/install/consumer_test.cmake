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

string(REPLACE "," ";" folders "${FOLDERS}")
list(GET folders 0 bin)
list(GET folders 1 lib)
list(GET folders 2 include)
list(GET folders 3 data)
list(GET folders 4 man)
list(GET folders 5 doc)
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
# Each header compiles without those that are not installed, nor those of libraries that only the inside uses.
file(GLOB_RECURSE headers RELATIVE ${prefix}/${include} ${prefix}/${include}/raytrace/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${prefix}/${include}/${header} included REGEX "^#include ")
  foreach(line IN LISTS included)
    if(line MATCHES "\"(raytrace/.*)\"" AND NOT EXISTS ${prefix}/${include}/${CMAKE_MATCH_1})
      message(FATAL_ERROR "${header} includes ${CMAKE_MATCH_1}, which is not installed")
    elseif(line MATCHES "<((half|png|tbb/|xsimd/|nlohmann/|embree4/).*)>")
      message(FATAL_ERROR "${header} includes ${CMAKE_MATCH_1}, which is another library's")
    endif()
  endforeach()
endforeach()
run(${prefix}/${bin}/raytrace --version)
# Each scene loads, with the files that it names.
file(GLOB_RECURSE scenes ${prefix}/${data}/raytrace/scenes/*.xml)
run(${prefix}/${bin}/raytrace --validate ${scenes})
file(READ ${CONSUMER}/main.cpp program)
file(READ ${prefix}/${doc}/docs/library.md page)
string(FIND "${page}" "${program}" position)
if(position EQUAL -1)
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
set(whole ${SCRATCH}/whole.jpg)
if(SANITIZERS)
  set(whole ${SCRATCH}/whole.exr)
endif()
run(${SCRATCH}/build/consumer "${SCRATCH}/ball.####.exr" ${whole})
foreach(picture IN ITEMS ${SCRATCH}/ball.0001.exr ${SCRATCH}/ball.0003.exr ${whole})
  if(NOT EXISTS ${picture})
    message(FATAL_ERROR "the consumer wrote no ${picture}:\n${output}")
  endif()
endforeach()
file(GLOB checkpoints ${SCRATCH}/*.checkpoint.exr)
if(checkpoints)
  message(FATAL_ERROR "checkpoints of finished frames are still there: ${checkpoints}")
endif()
# A second run has nothing to do but for the picture in two parts.
run(${SCRATCH}/build/consumer "${SCRATCH}/ball.####.exr" ${whole})
if(NOT output MATCHES "ball.0003.exr: there already, skipped")
  message(FATAL_ERROR "the consumer rendered a frame again:\n${output}")
endif()
