# cmake -DPROGRAM=... -DEXPECTED=... [-DEMULATOR=...] -P check_output.cmake: what PROGRAM prints is what EXPECTED
# holds. EMULATOR runs programs for another processor.

execute_process(COMMAND ${EMULATOR} "${PROGRAM}" OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}")
endif()
file(READ "${EXPECTED}" expected)
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "printed:\n${printed}\nexpected (${EXPECTED}):\n${expected}")
endif()
