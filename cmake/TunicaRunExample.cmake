# SPDX-License-Identifier: Apache-2.0
# cmake -D TUNICA=… -D PLUGIN=… -D VERB=run|diagnose -D EXPERIMENT=… -D OUTPUT=… [-D CHECK=…] -P TunicaRunExample.cmake
# runs an experiment with a plugin. CHECK is CMake code that says what to expect of result.json, keys by their path:
#   tunica_expect_between(LOW HIGH path…)   a number
#   tunica_expect_equal(TEXT path…)         a text
file(REMOVE_RECURSE ${OUTPUT})
execute_process(COMMAND ${TUNICA} --allow-world-writable-plugins --plugin-path ${PLUGIN} ${VERB} ${EXPERIMENT} -o ${OUTPUT}
                RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "tunica ${VERB} ${EXPERIMENT}: exit code ${code}")
endif()
file(READ ${OUTPUT}/result.json result)

function(tunica_expect_between low high)
  string(JSON found GET "${result}" ${ARGN})
  if(NOT found GREATER_EQUAL low OR NOT found LESS_EQUAL high)
    message(SEND_ERROR "${OUTPUT}/result.json, ${ARGN}: found ${found}, expected ${low} to ${high}")
  endif()
endfunction()
function(tunica_expect_equal expected)
  string(JSON found GET "${result}" ${ARGN})
  if(NOT found STREQUAL expected)
    message(SEND_ERROR "${OUTPUT}/result.json, ${ARGN}: found '${found}', expected '${expected}'")
  endif()
endfunction()

if(CHECK)
  include(${CHECK})
endif()
