# The viewer's page, compiled into the library: cmake -DFOLDER=pictures/viewer -DOUT=viewer_page.cpp -P
# viewer.cmake puts the style and the scripts, in the order of order.txt, into page.html; -DMINIFY=/usr/bin/minify makes
# them small. Included by a CMakeLists, it adds that step to the build. Neither node nor npm is needed.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  file(GLOB page CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/pictures/viewer/*.js)
  list(APPEND page ${PROJECT_SOURCE_DIR}/pictures/viewer/page.html
       ${PROJECT_SOURCE_DIR}/pictures/viewer/page.css ${PROJECT_SOURCE_DIR}/pictures/viewer/order.txt)
  set(out ${PROJECT_BINARY_DIR}/generated/viewer_page.cpp)
  # The minify of Debian: npm has another program of this name.
  find_program(ROVERNET_MINIFY minify)
  set(minify "")
  if(ROVERNET_MINIFY)
    execute_process(COMMAND ${ROVERNET_MINIFY} --version OUTPUT_VARIABLE version ERROR_QUIET)
    if(version MATCHES "^minify v?2[.]")
      set(minify ${ROVERNET_MINIFY})
    endif()
  endif()
  if(NOT minify)
    message(STATUS "The viewer's page is not minified: the package minify is not installed")
  endif()
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/pictures/viewer -DOUT=${out}
            -DMINIFY=${minify} -P ${CMAKE_CURRENT_LIST_FILE}
    DEPENDS ${page} ${CMAKE_CURRENT_LIST_FILE}
    COMMENT "Putting the viewer's page together"
    VERBATIM)
  target_sources(rovernet_upper PRIVATE ${out})
  set_source_files_properties(${out} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                              SKIP_PRECOMPILE_HEADERS ON)
  return()
endif()

# SHA-256 of a text in base64, as a Content-Security-Policy wants it.
function(csp_hash text out)
  set(letters "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  string(SHA256 hex "${text}")
  string(APPEND hex "00")  # 32 bytes and one more: 11 groups of 3
  set(base64 "")
  foreach(group RANGE 10)
    math(EXPR at "6 * ${group}")
    string(SUBSTRING "${hex}" ${at} 6 digits)
    foreach(shift 18 12 6 0)
      math(EXPR letter "(0x${digits} >> ${shift}) & 63")
      string(SUBSTRING "${letters}" ${letter} 1 letter)
      string(APPEND base64 "${letter}")
    endforeach()
  endforeach()
  string(SUBSTRING "${base64}" 0 43 base64)
  set(${out} "sha256-${base64}=" PARENT_SCOPE)
endfunction()

# A C++ string literal of a text, in pieces that every compiler takes.
function(literal text out)
  string(LENGTH "${text}" length)
  set(result "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 piece)
    string(APPEND result "R\"page(${piece})page\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  set(${out} "${result}" PARENT_SCOPE)
endfunction()

# A text without the comments and blanks that nobody needs, by minify if there is one.
function(shorten type text out)
  if(MINIFY)
    file(WRITE ${OUT}.${type} "${text}")
    execute_process(COMMAND ${MINIFY} --type=${type} --html-keep-comments ${OUT}.${type} OUTPUT_VARIABLE text
                    ERROR_VARIABLE error RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "minify cannot read the viewer's page: ${error}")
    endif()
    file(REMOVE ${OUT}.${type})
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

file(READ ${FOLDER}/page.html html)
file(READ ${FOLDER}/page.css style)
file(STRINGS ${FOLDER}/order.txt names)
set(script "")
foreach(name ${names})
  file(READ ${FOLDER}/${name} part)
  string(APPEND script "${part}")
endforeach()
# Strict mode once; one function around all, so that their names may be short.
string(REPLACE "    \"use strict\";\n" "" script "${script}")
string(PREPEND script "\"use strict\";\n(() => {\n")
string(APPEND script "})();\n")
shorten(js "${script}" script)
shorten(css "${style}" style)
shorten(html "${html}" html)  # its marks are comments
csp_hash("${style}" style_hash)
csp_hash("${script}" script_hash)
string(REPLACE "<!--STYLE-->" "<style>${style}</style>" html "${html}")
string(REPLACE "<!--SCRIPT-->" "<script>${script}</script>" html "${html}")
literal("${html}" html)
file(WRITE ${OUT} "// Made by cmake/viewer.cmake of the files in pictures/viewer.
#include \"pictures/viewer/view_page.hpp\"

namespace rovernet {

const std::string_view viewer_html =
${html};
const std::string_view viewer_policy =
    \"default-src 'none'; script-src '${script_hash}'; style-src '${style_hash}'; img-src data: blob:\";

}  // namespace rovernet
")
