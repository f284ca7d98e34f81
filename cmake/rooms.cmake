# sources_in(REGEX OUT SOURCE...): those sources whose path in the tree matches, wherever the tree is.
function(sources_in regex out)
  set(found "")
  foreach(source IN LISTS ARGN)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE path)
    if(path MATCHES "${regex}")
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# compile_by_room(TARGET PRIVATE HEADER...), or compile_by_room(TARGET REUSE_FROM OTHER) with the headers of another
# target: all sources of a folder are compiled as one, and headers that most of them include are read once for all
# (a precompiled header): less than half the time for the whole, more after a change of one file. Names in anonymous
# namespaces then have to differ within a folder, and a file may lack an include: the presets without
# ROVERNET_BY_ROOM find that. For Release the engine's own rooms stay as they are: gcc inlines less in a large file,
# up to 2 % more instructions per reception. The sockets of live/ stay apart, as Boost.Asio takes longer to read than
# all the rest of it; and so does scene/images/stb_picture, whose library has short names.
function(compile_by_room target)
  if(NOT ROVERNET_BY_ROOM)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  sources_in("^live/carriers/(listeners|web_sockets)|^scene/images/stb_picture" apart ${sources})
  set_source_files_properties(${apart} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  list(REMOVE_ITEM sources ${apart})
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    sources_in("^(sim|models|network)/" engine ${sources})
    list(REMOVE_ITEM sources ${engine})
  endif()
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE room)
    string(REPLACE "/" "_" room ${room})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_precompile_headers(${target} ${ARGN})
endfunction()
