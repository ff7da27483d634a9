# The tables of docs/commands/options.md are what scripts/options-page makes of the program's help; and the check finds one
# that was changed. Takes SCRIPT, PROGRAM, PAGE and WORK (a folder of its own).
function(expect code words page)
  execute_process(COMMAND ${SCRIPT} --check --program ${PROGRAM} ${page}
    RESULT_VARIABLE got ERROR_VARIABLE said OUTPUT_QUIET)
  if(NOT got EQUAL code OR NOT said MATCHES "${words}")
    message(FATAL_ERROR "options-page --check ${page} ended with ${got}, not ${code}, and said:\n${said}")
  endif()
endfunction()

expect(0 "^$" ${PAGE})
file(READ ${PAGE} text)
string(REPLACE "| `--tau PIXELS` | How far" "| `--tau PIXELS` | By how much" changed "${text}")
if(changed STREQUAL text)
  message(FATAL_ERROR "${PAGE} has no row of --tau that could be changed")
endif()
file(WRITE ${WORK}/options.md "${changed}")
expect(1 "differs from what .* says" ${WORK}/options.md)
