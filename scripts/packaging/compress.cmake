# Debian's pages of the manual and changelogs are compressed, without names and times in them.
file(GLOB_RECURSE pages ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/share/man/*.1 ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/share/doc/orograph/changelog
  ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/share/man/*.1)
foreach(page IN LISTS pages)
  execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
