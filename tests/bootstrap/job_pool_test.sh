#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# job_pool_test.sh FOLDER_OF_CMAKE: what one job may take is counted when Ninja is told how much to compile at a time.
set -euo pipefail

here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cat >"$here/CMakeLists.txt" <<PROJECT
cmake_minimum_required(VERSION 3.25)
project(small CXX)
include($1/TunicaDefaults.cmake)
add_executable(small small.cpp)
PROJECT
echo 'int main() {}' >"$here/small.cpp"

fail() {
  printf 'FAILED: %s\n' "$1"
  cat "$here/configured"
  exit 1
}
# configure FOLDER WORD…: a build without a cache of compiled files, which OFF is no path to.
configure() {
  local folder=$1
  shift
  cmake -S "$here" -B "$here/$folder" -G Ninja -D CCACHE_PROGRAM=OFF "$@" >"$here/configured" 2>&1 || fail "cmake"
}
unset CMAKE_BUILD_PARALLEL_LEVEL CMAKE_CXX_COMPILER_LAUNCHER

configure cold -D TUNICA_PRECOMPILED_HEADERS=ON
grep -q 'ggc-min-heapsize=2097152' "$here/cold/build.ninja" || fail "the memory of a job is not that of a cold build"
depth=$(awk '/^pool compile/ {found = 1} found && /depth = / {print $3; exit}' "$here/cold/CMakeFiles/rules.ninja")
total=$(awk '/^MemTotal:/ {print int($2 / 2097152)}' /proc/meminfo)
((depth >= 1 && depth <= (total > 1 ? total : 1))) || fail "the pool has ${depth:-no} places, and memory is for $total"
grep -q '^  pool = compile' "$here/cold/build.ninja" || fail "compilations are in no pool"

configure warm -D TUNICA_PRECOMPILED_HEADERS=OFF
! grep -q 'pool = compile' "$here/warm/build.ninja" || fail "a pool where g++ takes little"

CMAKE_BUILD_PARALLEL_LEVEL=3 configure chosen -D TUNICA_PRECOMPILED_HEADERS=ON
! grep -q 'pool = compile' "$here/chosen/build.ninja" || fail "a pool where the number of jobs was chosen"
