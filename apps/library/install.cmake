# Where the library, its header and what finds it are installed: pkg-config's orograph.pc, and find_package(Orograph), which has
# the target Orograph::orograph. All of it is in the one package.
install(TARGETS orograph_library LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${CMAKE_CURRENT_LIST_DIR}/orograph.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/orograph)
# Both say where they are by where they lie, so that an installation can be moved.
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY /prefix OUTPUT_VARIABLE library_folder)
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY /prefix OUTPUT_VARIABLE include_folder)
cmake_path(RELATIVE_PATH include_folder BASE_DIRECTORY ${library_folder} OUTPUT_VARIABLE OROGRAPH_INCLUDE_FROM_LIB)
configure_file(${CMAKE_CURRENT_LIST_DIR}/orograph.pc.in ${CMAKE_BINARY_DIR}/lib/orograph.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/lib/orograph.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
configure_file(${CMAKE_CURRENT_LIST_DIR}/OrographConfig.cmake.in ${CMAKE_BINARY_DIR}/lib/OrographConfig.cmake @ONLY)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/lib/OrographConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/lib/OrographConfig.cmake ${CMAKE_BINARY_DIR}/lib/OrographConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Orograph)
# The module of Python over the library. It is found where Debian looks for modules, and looks for the library from there.
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/../python/orograph DESTINATION lib/python3/dist-packages
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
