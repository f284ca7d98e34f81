# A Debian package of what is installed:  cpack --config build/release/CPackConfig.cmake
set(CPACK_GENERATOR DEB)
# So that what is installed sees this prefix, and not that of the folder in which it is packed.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the rovernet authors <rovernet@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulator of wireless networks of moving robots")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The libraries that its programs are linked with; the Python package is for this version of Python.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(TARGET rovernet_python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  string(CONCAT CPACK_DEBIAN_PACKAGE_DEPENDS
         "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), "
         "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-numpy)
endif()
set(CPACK_STRIP_FILES ON)
include(CPack)
