# cmake -DBUILD=folder -DPREFIX=folder -P: installs what was built, without what an earlier run left.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} RESULT_VARIABLE code
  OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the installation ended with ${code}:\n${said}")
endif()
