# SPDX-License-Identifier: Apache-2.0
# What every target of the project shares: C++20, hidden visibility, warnings, sanitizers, output folders.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# The executable and its plugins lie beside each other as they do when installed (bin, lib/tunica/plugins).
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(TUNICA_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/tunica/plugins)

add_library(tunica_developer INTERFACE)
target_compile_options(tunica_developer INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${TUNICA_WERROR}>:-Werror>)
# g++ 12 sees overlaps in std::string that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(tunica_developer INTERFACE -Wno-restrict)
endif()
if(TUNICA_SANITIZE)
  add_compile_options(-fsanitize=${TUNICA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TUNICA_SANITIZE})
  # Under a sanitizer Eigen aligns memory by hand, and libraries that were built without one do not.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(TUNICA_SANITIZE MATCHES thread)
  foreach(header blocked_range global_control info parallel_for partitioner task_arena)
    foreach(folder tbb oneapi/tbb)
      file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/loops/${folder}/${header}.h
           CONTENT "#include \"${CMAKE_CURRENT_LIST_DIR}/loops_on_threads.hpp\"\n" @ONLY)
    endforeach()
  endforeach()
  include_directories(BEFORE ${CMAKE_BINARY_DIR}/loops)
endif()
if(TUNICA_COVERAGE)
  add_compile_options(--coverage)
  add_compile_definitions(TUNICA_COVERAGE)
  add_link_options(--coverage)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Paths are hashed relative to the build folder, so build folders and clones share compiled files.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true
                                  CCACHE_SLOPPINESS=pch_defines,time_macros
                                  ${CCACHE_PROGRAM})
endif()

if(TUNICA_PRECOMPILED_HEADERS AND NOT CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache)
  set(TUNICA_COLD_BUILD TRUE)  # every file is compiled, so that it pays to spend memory on it
endif()
# g++ collects its garbage from 128 MiB on. With 2 GiB hardly a file of this project gets there, for up to 2 GiB a job.
if(TUNICA_COLD_BUILD)
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=2097152>)
  # Ninja starts as many jobs as there are cores, and two. It compiles no more at a time than the memory that is free
  # now carries, unless CMAKE_BUILD_PARALLEL_LEVEL says how many jobs there shall be, as ./bootstrap does.
  if(CMAKE_GENERATOR MATCHES "Ninja" AND NOT DEFINED ENV{CMAKE_BUILD_PARALLEL_LEVEL} AND NOT CMAKE_JOB_POOL_COMPILE)
    cmake_host_system_information(RESULT free_memory QUERY AVAILABLE_PHYSICAL_MEMORY)  # MiB
    math(EXPR carried "${free_memory} / 2048")
    if(carried LESS 1)
      set(carried 1)
    endif()
    set_property(GLOBAL APPEND PROPERTY JOB_POOLS compile=${carried})
    set(CMAKE_JOB_POOL_COMPILE compile)
  endif()
endif()

# tunica_precompiled_headers(NAME TYPE HEADERS ... LIBRARIES ... OPTIONS ...): headers that many targets include, compiled once
# for all targets that are compiled like it; TYPE is LIBRARY or PROGRAM. Such a target takes them by
# tunica_use_precompiled_headers(TARGET NAME). A cache of compiled files does better without: to it they are new with every
# build, and so is whatever was compiled with them.
function(tunica_precompiled_headers name type)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  if(NOT TUNICA_COLD_BUILD)
    return()
  endif()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "// Carries a precompiled header; nothing is linked from here.\n")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} tunica_developer)
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  if(type STREQUAL "PROGRAM")
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${name} PRIVATE -fPIE)
  endif()
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()
function(tunica_use_precompiled_headers target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()
