# A Debian package: cpack in the build folder of launch_scripts/build_program.sh, then
# 'apt install ./cca-mrpt_*.deb'. What it needs is read off the libraries that it links.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cca-mrpt)
set(CPACK_PACKAGE_CONTACT "cca_mrpt maintainers <maintainers@users.noreply.cca-mrpt.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Poly-line maps and exploration with 2-D lasers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/src)
include(CPack)
