# cmake -D ROOT=... -D BUILD=... -D CTEST=... -P budgets.cmake
# Holds tests/budgets.txt against the labels of the build's tests and against the steps of .ci/run.
cmake_minimum_required(VERSION 3.24)

set(most_seconds 2700)

file(STRINGS ${ROOT}/tests/budgets.txt lines REGEX "^(label|step) ")
set(labels "")
set(steps "")
set(sum 0)
foreach(line IN LISTS lines)
  if(line MATCHES "^label +([a-z0-9]+) +[0-9]+( +(asan|tsan|debian13))*$")
    list(APPEND labels ${CMAKE_MATCH_1})
  elseif(line MATCHES "^step +([0-9]+) (.*)$")
    math(EXPR sum "${sum} + ${CMAKE_MATCH_1}")
    list(APPEND steps "${CMAKE_MATCH_2}")
  else()
    message(SEND_ERROR "tests/budgets.txt: not understood: ${line}")
  endif()
endforeach()
if(sum GREATER most_seconds)
  message(SEND_ERROR "tests/budgets.txt: the steps take ${sum} s together; .ci/run may take ${most_seconds}")
endif()

# expect_same(what list other_what other_list): each is in both.
function(expect_same what list other_what other_list)
  foreach(name IN LISTS list)
    if(NOT name IN_LIST other_list)
      message(SEND_ERROR "\"${name}\" is in ${what}, but not in ${other_what}")
    endif()
  endforeach()
endfunction()

execute_process(COMMAND ${CTEST} --test-dir ${BUILD} --print-labels OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*All Labels:\n" "" output "${output}")
string(REGEX MATCHALL "[a-z0-9]+" used "${output}")
list(REMOVE_ITEM used fuzz long)  # builds for fuzzers have them
expect_same("tests/budgets.txt" "${labels}" "the labels of the tests" "${used}")
expect_same("the labels of the tests" "${used}" "tests/budgets.txt" "${labels}")

file(STRINGS ${ROOT}/.ci/run lines REGEX "^ *step \"")
set(run "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^ *step \"([^\"]*)\".*" "\\1" name "${line}")
  list(APPEND run "${name}")
endforeach()
expect_same("tests/budgets.txt" "${steps}" ".ci/run" "${run}")
expect_same(".ci/run" "${run}" "tests/budgets.txt" "${steps}")
