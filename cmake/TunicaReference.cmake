# SPDX-License-Identifier: Apache-2.0
# Target `reference`: the SDK reference as HTML in reference/ of the build folder, where Doxygen is installed.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  set(reference ${CMAKE_BINARY_DIR}/reference)
  file(CONFIGURE OUTPUT ${reference}/Doxyfile @ONLY CONTENT [[
@INCLUDE = "@PROJECT_SOURCE_DIR@/docs/Doxyfile"
PROJECT_NUMBER = @PROJECT_VERSION@
OUTPUT_DIRECTORY = "@reference@"
]])
  add_custom_target(reference COMMAND Doxygen::doxygen ${reference}/Doxyfile WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                    VERBATIM COMMENT "SDK reference: ${reference}/index.html")
endif()
