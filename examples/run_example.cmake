# SPDX-License-Identifier: Apache-2.0
# cmake -D TUNICA=… [-D VERB=cohort] -D EXPERIMENT=… -D OUTPUT=… -D PYTHON=… -P run_example.cmake
file(REMOVE_RECURSE ${OUTPUT})
if(NOT VERB)
  set(VERB run)
endif()
get_filename_component(folder ${EXPERIMENT} DIRECTORY)
# A build tree may be writable by others, as in a container; an installation is held to the rule.
execute_process(COMMAND ${TUNICA} --allow-world-writable-plugins ${VERB} ${EXPERIMENT} -o ${OUTPUT} RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "tunica ${VERB} ${EXPERIMENT}: exit code ${code}")
endif()
if(EXISTS ${folder}/check.py)
  # A check may call tunica itself: the words of its command, separated by ";".
  set(ENV{TUNICA} "${TUNICA};--allow-world-writable-plugins")
  execute_process(COMMAND ${PYTHON} ${folder}/check.py ${OUTPUT} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${folder}/check.py is not content with ${OUTPUT}/result.json")
  endif()
endif()
