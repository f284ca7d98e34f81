# Gives experiment/version.cpp, and nothing else, "version_build.hpp": what was built, from which
# commit, how. The commit is looked up again whenever a source file or git's HEAD has changed; the
# header is written only when its text differs.

string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
get_target_property(options rovernet_options INTERFACE_COMPILE_OPTIONS)
list(FILTER options EXCLUDE REGEX "^-W|^\\$")
list(JOIN options " " options)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${options}" ROVERNET_FLAGS)

set(generated ${PROJECT_BINARY_DIR}/generated)
configure_file(cmake/version_build.cmake.in version_build.cmake @ONLY)
add_custom_command(
  OUTPUT ${generated}/version_build.hpp
  COMMAND ${CMAKE_COMMAND} -P ${PROJECT_BINARY_DIR}/version_build.cmake
  DEPENDS ${ROVERNET_ENGINE_SOURCES} ${ROVERNET_UPPER_SOURCES} ${ROVERNET_HEADERS} ${ROVERNET_CLI_SOURCES}
          ${PROJECT_BINARY_DIR}/version_build.cmake
  DEPFILE ${generated}/version_build.d
  COMMENT "Looking up the git commit"
  VERBATIM)
target_sources(rovernet_scenarios PRIVATE ${generated}/version_build.hpp)
set_source_files_properties(${PROJECT_SOURCE_DIR}/experiment/version.cpp PROPERTIES
                            INCLUDE_DIRECTORIES ${generated}
                            SKIP_UNITY_BUILD_INCLUSION ON)
