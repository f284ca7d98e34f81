# The library and the command, compiled in parts. The program rovernet_run, the command `run` alone, consists of
# the first three parts: tools/rovernet builds it first, and a fresh clone shows results after half of the time.
#
#   engine     the event loop, radio, motion, maps, traces, sessions  optimised: what a run spends its time in;
#              statistics, which tests draw ten thousand times
#   scenarios  from a scenario file to a run and its results         less so: two thirds of the time to compile
#   terminal   the command line, and the command `run`               less so
#   streams    clients that drive a run step by step, and the        optimised: bench/live is a fifth slower without,
#              columns of the viewer                                 `view` of a large run a seventh
#   upper      replay, reports, pictures, studies, live runs         less so
#   commands   the other commands                                    less so
include(cmake/rooms.cmake)
include(cmake/python.cmake)

sources_in("^experiment/(session|client_radios|driven_robots)|^study/statistics/" engine_sources
           ${ROVERNET_UPPER_SOURCES})
sources_in("^live/lockstep/|^pictures/viewer/(frame_columns|view_run|view_series)" stream_sources
           ${ROVERNET_UPPER_SOURCES})
set(upper_sources ${ROVERNET_UPPER_SOURCES})
list(REMOVE_ITEM upper_sources ${engine_sources} ${stream_sources})
sources_in("^scenario/|^experiment/[^/]*$" scenario_sources ${upper_sources})
list(REMOVE_ITEM upper_sources ${scenario_sources})

# add_part(NAME fast|brief SOURCE...): brief parts are compiled with -Og, and in Debug not optimised at all. Parts
# of a kind share a precompiled header. In a build with Python all are position-independent: the library becomes
# part of a module, where calls within it stay direct, at no instruction more.
set(common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
                   <optional> <set> <span> <string> <string_view> <tuple> <utility> <variant> <vector>
                   <fmt/format.h>)
set(fast_headers PRIVATE ${common_headers})
set(brief_headers PRIVATE ${common_headers} <network/network.hpp> <scenario/scenario.hpp>)
function(add_part name kind)
  set(part rovernet_${name})
  add_library(${part} OBJECT ${ARGN})
  target_compile_features(${part} PRIVATE cxx_std_20)
  target_include_directories(${part} PRIVATE ${PROJECT_SOURCE_DIR})
  # toml++ as Debian builds it: the system's library, not header-only.
  target_compile_definitions(${part} PRIVATE TOML_HEADER_ONLY=0 TOML_SHARED_LIB=1)
  target_link_libraries(${part} PRIVATE rovernet_options fmt::fmt Boost::headers nlohmann_json::nlohmann_json)
  if(kind STREQUAL brief)
    target_compile_options(${part} PRIVATE $<IF:$<CONFIG:Debug>,-O0,$<$<CONFIG:Release>:-Og>>)
  endif()
  if(BUILD_PYTHON)
    set_target_properties(${part} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${part} PRIVATE -fno-semantic-interposition)
  endif()
  compile_by_room(${part} ${${kind}_headers})
  set(${kind}_headers REUSE_FROM ${part} PARENT_SCOPE)
endfunction()

add_part(engine fast ${ROVERNET_ENGINE_SOURCES} ${engine_sources})
add_part(scenarios brief ${scenario_sources})
add_part(streams fast ${stream_sources})
add_part(upper brief ${upper_sources})
include(cmake/version.cmake)
include(cmake/viewer.cmake)

# What the library is linked with: by name, so that no path of this machine enters the installed package.
set(libraries fmt::fmt PNG::PNG ZLIB::ZLIB yaml-cpp tomlplusplus xxhash zstd SQLiteCpp sqlite3 simdjson)
set(engine_and_scenarios $<TARGET_OBJECTS:rovernet_engine> $<TARGET_OBJECTS:rovernet_scenarios>)
add_library(rovernet ${engine_and_scenarios} $<TARGET_OBJECTS:rovernet_streams> $<TARGET_OBJECTS:rovernet_upper>)
add_library(rovernet::rovernet ALIAS rovernet)
set_target_properties(rovernet PROPERTIES LINKER_LANGUAGE CXX)
target_compile_features(rovernet PUBLIC cxx_std_20)
target_compile_options(rovernet PUBLIC -ffp-contract=off)
target_include_directories(rovernet PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rovernet>)
target_link_libraries(rovernet PUBLIC fmt::fmt PRIVATE ${libraries})

if(ROVERNET_CLI_SOURCES)
  find_package(CLI11 REQUIRED)
  set(mains ${PROJECT_SOURCE_DIR}/cli/main.cpp ${PROJECT_SOURCE_DIR}/cli/run/main.cpp)
  list(REMOVE_ITEM ROVERNET_CLI_SOURCES ${mains})
  sources_in("^cli/(terminal|run)/" terminal_sources ${ROVERNET_CLI_SOURCES})
  set(command_sources ${ROVERNET_CLI_SOURCES})
  list(REMOVE_ITEM command_sources ${terminal_sources})
  add_part(terminal brief ${terminal_sources})
  add_part(commands brief ${command_sources})
  foreach(part IN ITEMS rovernet_terminal rovernet_commands)
    target_link_libraries(${part} PRIVATE CLI11::CLI11 spdlog::spdlog)
  endforeach()

  add_executable(rovernet_cli cli/main.cpp $<TARGET_OBJECTS:rovernet_terminal> $<TARGET_OBJECTS:rovernet_commands>)
  set_target_properties(rovernet_cli PROPERTIES OUTPUT_NAME rovernet)
  target_link_libraries(rovernet_cli PRIVATE rovernet rovernet_options spdlog::spdlog)
  include(cmake/command.cmake)

  add_executable(rovernet_run cli/run/main.cpp ${engine_and_scenarios}
                                               $<TARGET_OBJECTS:rovernet_terminal>)
  target_include_directories(rovernet_run PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(rovernet_run PRIVATE rovernet_options ${libraries} spdlog::spdlog)
endif()
