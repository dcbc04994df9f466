# SPDX-License-Identifier: Apache-2.0
# include/tunica; apps/tunica installs bin/tunica, tunica_add_plugin() lib/<multiarch>/tunica/plugins/*.so.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/include/tunica DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# What a user runs, without tests and benchmarks: ./bootstrap run builds no more.
get_property(plugins GLOBAL PROPERTY TUNICA_PLUGINS)
add_custom_target(product DEPENDS ${plugins})
if(TARGET tunica)
  add_dependencies(product tunica)
endif()
