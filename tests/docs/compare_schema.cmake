# SPDX-License-Identifier: Apache-2.0
execute_process(COMMAND ${TUNICA} schema OUTPUT_VARIABLE printed RESULT_VARIABLE code)
file(READ ${SCHEMA} committed)
if(NOT code EQUAL 0 OR NOT printed STREQUAL committed)
  message(FATAL_ERROR "${SCHEMA} differs from what `tunica schema` prints; write it anew: tunica schema -o ${SCHEMA}")
endif()
