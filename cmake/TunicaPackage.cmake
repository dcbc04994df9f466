# SPDX-License-Identifier: Apache-2.0
# cpack -G DEB: tunica (the program and its plugins), tunica-dev (what plugins are built with) and, where it was built,
# python3-tunica (the Python package).
# cpack --config CPackSourceConfig.cmake: the sources.
set(CPACK_PACKAGE_NAME tunica)
set(CPACK_PACKAGE_VENDOR "tunica developers")
set(CPACK_PACKAGE_CONTACT "tunica developers <tunica@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME tunica)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME tunica-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# A plugin is built for one API number: both packages go together.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "tunica (= ${PROJECT_VERSION}), libeigen3-dev, nlohmann-json3-dev, libceres-dev, g++, cmake (>= 3.25)")
if(TARGET full_field)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libgmsh4.8")  # opened where a measured field is meshed
endif()
if(TARGET tunica_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tunica)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # The package contains program and plugins of one build.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "tunica (= ${PROJECT_VERSION}), ${TUNICA_PYTHON_DEPENDS}, python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python package of tunica: runs, diagnoses, problems for scipy, own models")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, CMake package and pkg-config file for plugins of tunica")
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME tunica-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES "/build/;/\\\\.git/;/results/")
include(CPack)
