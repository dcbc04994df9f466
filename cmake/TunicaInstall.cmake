# SPDX-License-Identifier: Apache-2.0
# What is installed, in two components: runtime (bin/tunica, plugins, pages, examples) and development (headers, CMake, pkg-config). The
# rules of the program and the plugins stand with their targets. Every path is relative: the tree may be moved.
include(CMakePackageConfigHelpers)
file(STRINGS ${PROJECT_SOURCE_DIR}/core/include/tunica/plugin.hpp line REGEX "#define TUNICA_PLUGIN_API [0-9]+")
string(REGEX MATCH "[0-9]+$" TUNICA_PLUGIN_API "${line}")

set(TUNICA_CMAKE_INSTALL_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tunica)
set(TUNICA_PLUGIN_INSTALL_DIR ${CMAKE_INSTALL_LIBDIR}/tunica/plugins)
file(RELATIVE_PATH TUNICA_PREFIX_FROM_PKGCONFIG /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
set(generated ${CMAKE_CURRENT_BINARY_DIR}/package)
configure_package_config_file(cmake/tunicaConfig.cmake.in ${generated}/tunicaConfig.cmake
  INSTALL_DESTINATION ${TUNICA_CMAKE_INSTALL_DIR} PATH_VARS CMAKE_INSTALL_BINDIR TUNICA_PLUGIN_INSTALL_DIR)
# Before 1.0 a minor release may change the SDK; TUNICA_PLUGIN_API identifies the version that a plugin was built for.
write_basic_package_version_file(${generated}/tunicaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(cmake/tunica.pc.in ${generated}/tunica.pc @ONLY)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/include/tunica DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(TARGETS tunica_sdk tunica_kernels EXPORT tunicaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT development)
install(EXPORT tunicaTargets NAMESPACE tunica:: DESTINATION ${TUNICA_CMAKE_INSTALL_DIR} COMPONENT development)
install(FILES ${generated}/tunicaConfig.cmake ${generated}/tunicaConfigVersion.cmake cmake/TunicaAddPlugin.cmake
              cmake/TunicaTestPlugin.cmake cmake/TunicaRunExample.cmake cmake/tunica_plugin.map
        DESTINATION ${TUNICA_CMAKE_INSTALL_DIR} COMPONENT development)
install(FILES ${generated}/tunica.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
# The manual page and the completions of bash and zsh, which the program writes itself (apps/tunica).
foreach(folder man/man1 bash-completion/completions zsh/site-functions)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/share/${folder}/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/${folder} COMPONENT runtime)
endforeach()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
# The pages, the examples and the schemas, in the places that they have here: links between them go on to work.
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime
        PATTERN "examples/CMakeLists.txt" EXCLUDE PATTERN "run_example.cmake" EXCLUDE PATTERN "__pycache__" EXCLUDE
        PATTERN "build" EXCLUDE PATTERN "results" EXCLUDE PATTERN "out" EXCLUDE)
install(DIRECTORY schemas DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime FILES_MATCHING PATTERN "*.json")

# The programs for users, without tests and benchmarks. ./bootstrap run builds `first_result` before it and `product`
# after it. Rigs that few labs have, foams, programs of others and optimisers for comparison are no part of a first result;
# an experiment of the user's own may need them, and then `every_plugin` is built before it, too.
get_property(plugins GLOBAL PROPERTY TUNICA_PLUGINS)
set(later bulge cma_es controlled_strip dynamic_mechanical external fe_pressurisation full_field holzapfel_ogden hyperfoam
    indentation pagmo plane_specimen ring torsion um_bridge volume_change)
set(first_plugins ${plugins})
list(REMOVE_ITEM first_plugins ${later})
add_custom_target(first_result DEPENDS ${first_plugins})
add_custom_target(every_plugin DEPENDS ${plugins})
add_custom_target(product DEPENDS ${plugins})
if(TARGET tunica)
  add_dependencies(first_result tunica_first)
  add_dependencies(product tunica shell_files)
endif()
