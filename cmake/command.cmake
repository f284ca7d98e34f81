# What is installed with the command: its page of the manual and the completion of shells, printed by the command
# itself from the commands as they are declared.
set(run ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:rovernet_cli>)
set(printed ${PROJECT_BINARY_DIR}/printed)
file(MAKE_DIRECTORY ${printed})
function(print file)
  add_custom_command(TARGET rovernet_cli POST_BUILD VERBATIM BYPRODUCTS ${printed}/${file}
                     COMMAND sh -c "\"$@\" > \"$0\"" ${printed}/${file} ${run} ${ARGN})
endfunction()
print(rovernet.1 man)
print(bash completion bash)
print(zsh completion zsh)
print(fish completion fish)

install(TARGETS rovernet_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(FILES ${printed}/rovernet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${printed}/bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME rovernet
        COMPONENT command)
install(FILES ${printed}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _rovernet
        COMPONENT command)
install(FILES ${printed}/fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME rovernet.fish
        COMPONENT command)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
# The pages that `rovernet help TOPIC` prints.
install(DIRECTORY docs/guide docs/methods docs/formats docs/inside docs/pictures
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command
        FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.png PATTERN *.csv)
