# A package for Debian, by CPack: scripts/packaging/make-deb. What it depends on is read from the built program.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME orograph)
set(CPACK_PACKAGE_VENDOR "the Orograph authors")
set(CPACK_PACKAGE_CONTACT "the Orograph authors <orograph@users.noreply.github.com>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "accurate pictures of terrain at its true place on the Earth")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Orograph opens elevation data (.hgt, GeoTIFF, whatever GDAL reads) by latitude
and longitude, places it on the WGS84 ellipsoid and draws it with Vulkan. It
says how accurate each picture is, and why. It draws pictures, maps, panoramas
with names, and films, answers what is seen from where, and has a window to fly
over a region.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CPACK_PACKAGE_CONTACT})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# PROJ's grids of datums, and something that draws.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "proj-data")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
# The second is for the module of Python.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RELEASE "$ENV{OROGRAPH_DEB_RELEASE}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/compress.cmake)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/orograph RENAME copyright)
install(FILES ${PROJECT_SOURCE_DIR}/docs/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/orograph RENAME changelog)
include(CPack)
