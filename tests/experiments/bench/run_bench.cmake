# Runs every benchmark once on a tiny mesh, and makes the table of it. Variables: BENCH and TABLE, the programs; JSON, the file between them.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${code}:\n${output}${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${BENCH} --tiny --benchmark_repetitions=1 --benchmark_out=${JSON})
file(READ ${JSON} json)
foreach(name floor smoothing/threads:2 baseline_laplacian/threads:1 stages/threads:1 off/threads:1 improve/threads:2 program/threads:2)
  if(NOT json MATCHES "\"name\": \"${name}/copies:0")
    message(FATAL_ERROR "Expected: a benchmark ${name}. Got:\n${json}")
  endif()
endforeach()
if(json MATCHES "error_occurred\": true")
  message(FATAL_ERROR "Expected: no errors. Got:\n${json}")
endif()

# As if the tiny mesh had been the smallest and the large one.
string(REPLACE "copies:0" "copies:1" small "${json}")
file(WRITE ${JSON} "${small}")
run(${TABLE} ${JSON})
if(NOT output MATCHES "smoothing, defaults, 65 k vertices, one thread . [0-9.e+]+ × floor")
  message(FATAL_ERROR "Expected: a table with the ratio to the floor. Got:\n${output}")
endif()
