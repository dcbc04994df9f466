# SPDX-License-Identifier: Apache-2.0
# tunica_test_plugin(NAME [EXPERIMENT file.json [CHECK file.cmake] [VERB run|diagnose]]): tests of a plugin made with
# tunica_add_plugin(): `tunica plugin check`, and an experiment that uses it, whose result the check looks at (see
# TunicaRunExample.cmake). The build folder is one's own, so it may be writable by others.
function(tunica_test_plugin name)
  cmake_parse_arguments(ARG "" "EXPERIMENT;CHECK;VERB" "" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tunica_test_plugin(${name}): found '${ARG_UNPARSED_ARGUMENTS}', expected EXPERIMENT, CHECK or VERB")
  endif()
  add_test(NAME ${name}.conformance
    COMMAND tunica::tunica --allow-world-writable-plugins plugin check $<TARGET_FILE:${name}>)
  if(ARG_EXPERIMENT)
    if(NOT ARG_VERB)
      set(ARG_VERB run)
    endif()
    cmake_path(ABSOLUTE_PATH ARG_EXPERIMENT)
    if(ARG_CHECK)
      cmake_path(ABSOLUTE_PATH ARG_CHECK)
    endif()
    add_test(NAME ${name}.example
      COMMAND ${CMAKE_COMMAND} -D TUNICA=$<TARGET_FILE:tunica::tunica> -D PLUGIN=$<TARGET_FILE:${name}> -D VERB=${ARG_VERB}
              -D EXPERIMENT=${ARG_EXPERIMENT} -D OUTPUT=${CMAKE_CURRENT_BINARY_DIR}/results -D CHECK=${ARG_CHECK}
              -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/TunicaRunExample.cmake)
  endif()
endfunction()
