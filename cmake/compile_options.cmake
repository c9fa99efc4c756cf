# How every source of the project is compiled: link raytrace_options, privately.
add_library(raytrace_options INTERFACE)
target_compile_features(raytrace_options INTERFACE cxx_std_20)
target_compile_options(raytrace_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion
  # Where several files are one translation unit, one file's names are not the other's business.
  $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
  # A picture must not depend on where the compiler saw fit to fuse a multiplication and an addition.
  -ffp-contract=off
  # GCC warns of overlaps and overflows inside "text" + std::string which cannot be: 12 by GCC bug 105651, and 14 where files
  # are joined.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>"
  # Clang warns of entry points with C names and C++ types, which we mean, and of deprecated functions that libstdc++'s own
  # std::stable_sort calls.
  "$<$<CXX_COMPILER_ID:Clang>:-Wno-return-type-c-linkage;-Wno-deprecated-declarations>"
  $<$<BOOL:${RAYTRACE_WERROR}>:-Werror>)
# Only libraries that are used: OpenImageIO brings 250, which a test that does not need them would take half a second to load.
target_link_options(raytrace_options INTERFACE LINKER:--as-needed)

if(RAYTRACE_SANITIZERS)
  # A report must fail the test that caused it, so nothing is recovered from.
  target_compile_options(raytrace_options INTERFACE
    -fsanitize=${RAYTRACE_SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # With -O2 and all of -g the compiler takes twice as long, and its files thrice the disk, for the same reports. The wide
    # code is worth it, or renders would take that time.
    $<IF:$<BOOL:$<TARGET_PROPERTY:RAYTRACE_WIDE>>,-O2,-O1> -g1
    # Less is inlined there, too: every check is code.
    "$<$<AND:$<CXX_COMPILER_ID:Clang>,$<NOT:$<BOOL:$<TARGET_PROPERTY:RAYTRACE_WIDE>>>>:SHELL:-mllvm -inline-threshold=20>")
  if(RAYTRACE_SANITIZERS MATCHES "address" AND RAYTRACE_SANITIZERS MATCHES "undefined")
    # The address sanitizer reports what these would.
    target_compile_options(raytrace_options INTERFACE -fno-sanitize=null,object-size)
  endif()
  if(RAYTRACE_SANITIZERS MATCHES "undefined")
    # A test's own arithmetic is not what is looked at, and takes a third of the compiler's time.
    target_compile_options(raytrace_options INTERFACE
      $<$<BOOL:$<TARGET_PROPERTY:RAYTRACE_TEST>>:-fno-sanitize=undefined>)
  endif()
  target_link_options(raytrace_options INTERFACE -fsanitize=${RAYTRACE_SANITIZERS})
endif()
if(RAYTRACE_SANITIZERS MATCHES "thread")
  # Headers in which our loops run on threads that the sanitizer knows, before the library's of the same names.
  include_directories(BEFORE ${PROJECT_SOURCE_DIR}/tests/sanitizers/threads)
endif()

if(RAYTRACE_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "RAYTRACE_FUZZERS needs Clang, which brings libFuzzer")
  endif()
  # The fuzzer follows coverage through the whole library.
  target_compile_options(raytrace_options INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:RAYTRACE_TEST>>>:-fsanitize=fuzzer-no-link>)
endif()
