# SPDX-License-Identifier: Apache-2.0
# Checks of the sources: licence lines, file lengths and formatting as tests (seconds), clang-tidy as target `lint`
# (minutes; it compiles every file once more).
if(TUNICA_BUILD_TESTS)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(style ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/style.py ${PROJECT_SOURCE_DIR})
  add_test(NAME Style.EverySourceHasItsLicenceLine COMMAND ${style} licence)
  add_test(NAME Style.FilesOver400LinesHaveAReason COMMAND ${style} lines)
  add_test(NAME Style.PublicHeadersExplainThemselves COMMAND ${style} comments)
  add_test(NAME Style.NoCodeDecidesBySearchingASentence COMMAND ${style} prose)
endif()

# Versions of clang-format disagree about the same style, so only the one of Debian 12 decides.
find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
if(CLANG_FORMAT)
  execute_process(COMMAND ${CLANG_FORMAT} --version OUTPUT_VARIABLE clang_format_version)
  if(clang_format_version MATCHES "version 14\\." AND TUNICA_BUILD_TESTS)
    add_test(NAME Style.SourcesAreFormatted COMMAND ${style} format ${CLANG_FORMAT})
  endif()
endif()

find_program(RUN_CLANG_TIDY NAMES run-clang-tidy-14 run-clang-tidy)
if(RUN_CLANG_TIDY)
  # clang does not know these options of g++; it would refuse every file for them.
  set(foreign_options -e "s/ -fno-gnu-unique//g" -e "s/ -Wno-restrict//g" -e "s/ --param=ggc[^ ]*//g")
  # In a unity build, joined files are read, which takes an eighth of the time; they include sources, as they should.
  set(sources "/(core|plugins|apps)/.*\\.(cpp|cxx|hpp)$")
  add_custom_target(lint
    COMMAND ${CMAKE_COMMAND} -E make_directory lint
    COMMAND sed ${foreign_options} compile_commands.json > lint/compile_commands.json
    COMMAND ${RUN_CLANG_TIDY} -quiet -p lint -header-filter=${sources} -extra-arg=-Wno-unknown-pragmas -extra-arg=-Wno-overlength-strings -checks=-bugprone-suspicious-include
      "(${PROJECT_SOURCE_DIR}|${CMAKE_BINARY_DIR})${sources}"
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR} VERBATIM USES_TERMINAL COMMENT "clang-tidy over core, plugins and apps")
  add_dependencies(lint tunica_templates tunica_page)  # sources that are made
endif()
