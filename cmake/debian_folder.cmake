# Run by cpack before it packs: gives each package its copyright and its changelog, as Debian wants them, and
# compresses these and the page of the manual.
get_filename_component(tree "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)
file(STRINGS ${tree}/CITATION.cff released REGEX "^date-released:")
string(REGEX REPLACE ".*: *" "" released "${released}")
execute_process(COMMAND date -R -u -d ${released} COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(package ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(doc ${usr}/share/doc/${package})
  file(REMOVE ${doc}/LICENSE)
  configure_file(${tree}/LICENSE ${doc}/copyright COPYONLY)
  file(WRITE ${doc}/changelog
       "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
       "  * Version ${CPACK_PACKAGE_VERSION}; its changes are in CHANGELOG.md of the sources.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(GLOB pages ${doc}/changelog ${usr}/share/man/man1/*.1)
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
  # Debian's folders, whatever the umask of who builds.
  execute_process(COMMAND chmod -R u=rwX,go=rX ${usr} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
