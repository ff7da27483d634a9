# docs/PERFORMANCE.md is what scripts/performance-page makes of docs/results; and the check finds a result that was changed,
# and a line that is no record. Takes SCRIPT, RESULTS (the folder) and WORK (a folder of its own).
function(expect code words folder)
  execute_process(COMMAND ${SCRIPT} --check --results ${folder} RESULT_VARIABLE got ERROR_VARIABLE said OUTPUT_QUIET)
  if(NOT got EQUAL code OR NOT said MATCHES "${words}")
    message(FATAL_ERROR "performance-page --check --results ${folder} ended with ${got}, not ${code}, and said:\n${said}")
  endif()
endfunction()

expect(0 "^$" ${RESULTS})

file(REMOVE_RECURSE ${WORK})
file(COPY ${RESULTS}/ DESTINATION ${WORK})
file(READ ${WORK}/nvidia-h100.json text)
if(NOT text MATCHES "\"median_ms\": ([0-9.]+),")
  message(FATAL_ERROR "nvidia-h100.json has no median that could be changed")
endif()
set(median ${CMAKE_MATCH_1})
string(REPLACE "\"median_ms\": ${median}," "\"median_ms\": 9${median}," changed "${text}")
file(WRITE ${WORK}/nvidia-h100.json "${changed}")
expect(1 "differs from what .* makes" ${WORK})

string(REPLACE "\"median_ms\": ${median}," "\"median_ms\": fast," changed "${text}")
file(WRITE ${WORK}/nvidia-h100.json "${changed}")
expect(2 "nvidia-h100.json:[0-9]+: this line is no record" ${WORK})
