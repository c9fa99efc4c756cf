# cmake -D NM=nm -D OBJECT=file.o -D ENTRY=symbol -P isolated_object.cmake: fails unless ENTRY is the one symbol that the
# object defines for others. nm writes such symbols in capitals, and u, v and w for unique and weak ones.
execute_process(COMMAND ${NM} --defined-only --format=posix ${OBJECT}
  OUTPUT_VARIABLE symbols RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "nm cannot read ${OBJECT}")
endif()
string(REGEX MATCHALL "[^\n]+ [A-Zuvw] [^\n]*" visible "${symbols}")
list(TRANSFORM visible REPLACE " .*" "")
if(NOT visible STREQUAL ENTRY)
  list(JOIN visible "\n  " visible)
  message(FATAL_ERROR "expected only ${ENTRY} to be visible in ${OBJECT}, but there is:\n  ${visible}")
endif()
