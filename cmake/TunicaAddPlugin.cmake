# SPDX-License-Identifier: Apache-2.0
# tunica_add_plugin(NAME SOURCES a.cpp ... [LIBRARIES ...] [INTERNAL]): a shared library that tunica loads at run time.
# It exports one symbol, tunica_plugin (tunica_plugin.map); -fno-gnu-unique keeps inline statics apart.
# Neither errno nor floating-point traps are read anywhere: without them loops vectorise, and no value changes.
set(TUNICA_PLUGIN_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique> -fno-math-errno -fno-trapping-math CACHE INTERNAL "")
function(tunica_add_plugin name)
  cmake_parse_arguments(ARG "INTERNAL" "" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "tunica_add_plugin(${name}): SOURCES is empty")
  endif()
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE tunica::sdk ${ARG_LIBRARIES})
  if(TARGET tunica_developer)
    target_link_libraries(${name} PRIVATE tunica_developer)
  endif()
  target_compile_options(${name} PRIVATE ${TUNICA_PLUGIN_OPTIONS})
  # An undefined symbol is an error here, not at load time; sanitizers leave theirs to the executable.
  set(exports ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/tunica_plugin.map)
  target_link_options(${name} PRIVATE -Wl,--version-script=${exports})
  if(NOT TUNICA_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                                           LINK_DEPENDS ${exports})
  if(ARG_INTERNAL)
    return()  # not installed, nor beside those that are
  endif()
  if(TARGET plugin_headers)
    # The same definitions on every command line, or plugins could not share the header: no <name>_EXPORTS, which nothing
    # reads, and what fmt asks for.
    set_target_properties(${name} PROPERTIES DEFINE_SYMBOL "")
    target_compile_definitions(${name} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
    target_precompile_headers(${name} REUSE_FROM plugin_headers)
  endif()
  if(TUNICA_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${TUNICA_PLUGIN_OUTPUT_DIRECTORY})
  endif()
  if(PROJECT_NAME STREQUAL "tunica")
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/tunica/plugins COMPONENT runtime)
    set_property(GLOBAL APPEND PROPERTY TUNICA_PLUGINS ${name})
  else()
    # Third-party plugins go to lib/tunica/plugins below their own prefix: of tunica itself, or in TUNICA_PLUGIN_PATH.
    include(GNUInstallDirs)
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/tunica/plugins)
  endif()
endfunction()
