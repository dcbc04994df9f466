# SPDX-License-Identifier: Apache-2.0
# cpp-httplib of Debian is a compiled library with pkg-config file and without CMake package: PkgConfig::HTTPLIB, where
# there is one. Its definitions decide the layout of its classes, so they come from the file too.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(HTTPLIB QUIET IMPORTED_TARGET GLOBAL cpp-httplib)
endif()
