# Debian packages of what is installed: rovernet (the command), librovernet-dev (for programs in C++) and
# python3-rovernet.   cpack -G DEB --config build/release/CPackConfig.cmake
set(CPACK_GENERATOR DEB)
# So that what is installed sees this prefix, and not that of the folder in which it is packed.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the rovernet authors <rovernet@example.org>")
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_folder.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL library)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# The libraries that programs and modules are linked with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
string(CONCAT what
       "rovernet answers one question well: does a message get there, given where\n"
       "the robots are, what stands between them, and how much of the physics\n"
       "matters? One map serves radio, motion and pictures.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME librovernet-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "g++, libfmt-dev, libpng-dev, libsimdjson-dev, libsqlite3-dev, libsqlitecpp-dev, libtomlplusplus-dev, libxxhash-dev, libyaml-cpp-dev, libzstd-dev, zlib1g-dev")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION
    "simulator of wireless networks of moving robots (library)\n${what}\n.\nThis package has the library and its headers, for programs in C++.")

if(TARGET rovernet_cli)
  list(APPEND CPACK_COMPONENTS_ALL command)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME rovernet)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_COMMAND_DESCRIPTION
      "simulator of wireless networks of moving robots\n${what}\n.\nThis package has the command rovernet.")
endif()

# For this version of Python.
if(TARGET rovernet_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rovernet)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
         "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), "
         "python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
      "simulator of wireless networks of moving robots (Python)\n${what}\n.\nThis package has the Python package rovernet.")
endif()
include(CPack)
