# Whether the Python package can be built, as BUILD_PYTHON: ROVERNET_PYTHON is AUTO (if pybind11 and
# Python's headers are there), ON or OFF. Never with sanitizers: a Python without them would have to
# load theirs before all else (LD_PRELOAD).
set(ROVERNET_PYTHON AUTO CACHE STRING "Build the Python package: AUTO, ON or OFF")
set(BUILD_PYTHON OFF)
string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
if(NOT ROVERNET_PYTHON)
  return()
endif()
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}" MATCHES "-fsanitize")
  message(STATUS "The Python package is not built: not with sanitizers")
  return()
endif()
# Debian's Python, which has numpy; another one that comes first in the PATH may have none.
if(EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the package is for")
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 QUIET)
if(Python_FOUND AND pybind11_FOUND)
  set(BUILD_PYTHON ON)
elseif(ROVERNET_PYTHON STREQUAL "AUTO")
  message(STATUS "The Python package is not built: tools/setup --python installs what it needs")
else()
  message(FATAL_ERROR "ROVERNET_PYTHON needs pybind11 2.10 and the headers of Python 3.9: "
                      "tools/setup --python installs them")
endif()
