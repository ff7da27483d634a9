# Writes what an installation has of the program's own words: the scripts by which shells complete them, and the pages of the
# manual. Takes PROGRAM (the built one) and SHARE (the folder `share` of an installation).

# What the program prints into a file. No leaks are looked for: libraries keep memory to the end.
function(write_printed file)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 ${PROGRAM} ${ARGN}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE said)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${ARGN} ended with ${code}: ${said}")
  endif()
  file(WRITE ${SHARE}/${file} "${text}")
  set(printed "${text}" PARENT_SCOPE)
endfunction()

write_printed(bash-completion/completions/orograph completion bash)
write_printed(zsh/site-functions/_orograph completion zsh)
write_printed(fish/vendor_completions.d/orograph.fish completion fish)
# The program's page names those of the commands.
write_printed(man/man1/orograph.1 manual)
string(REGEX MATCHALL "\n\\.BR orograph.-[a-z]+ \\(1\\)" commands "${printed}")
foreach(line IN LISTS commands)
  string(REGEX REPLACE ".*-([a-z]+) .*" "\\1" command "${line}")
  write_printed(man/man1/orograph-${command}.1 manual ${command})
endforeach()
