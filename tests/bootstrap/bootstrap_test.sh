#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bootstrap_test.sh BOOTSTRAP CASE: a copy of the script among pretended dpkg-query, apt-get, cmake and ctest.
set -euo pipefail

here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
chmod 755 "$here"
mkdir -p "$here/bin" "$here/build/release/bin" "$here/examples/lamb_aorta"
install -m 755 "$1" "$here/bootstrap"
touch "$here/examples/lamb_aorta/experiment.json"
export MISSING="" CTEST_STATUS=0 CTEST_OUTPUT="100% tests passed, 0 tests failed out of 7" CALLS="$here/calls"
touch "$CALLS" && chmod 666 "$CALLS"

# pretend NAME: reads the body of a program that stands in for NAME.
pretend() {
  { printf '#!/usr/bin/env bash\n' && cat; } >"$here/bin/$1"
  chmod 755 "$here/bin/$1"
}
pretend dpkg-query <<'BODY'
for package in $MISSING; do [[ ${!#} != "$package" ]] || exit 1; done
echo installed
BODY
pretend apt-get <<<'echo "apt-get $*" >>"$CALLS"'
pretend cmake <<<'echo "cmake $*" >>"$CALLS"'
pretend ctest <<<'printf "%s\n" "$CTEST_OUTPUT" "" "The following tests did not run:" "1 - x (Skipped)"; exit $CTEST_STATUS'
pretend sudo <<<'exec "$@"'
install -m 755 /dev/stdin "$here/build/release/bin/tunica_first" <<<'#!/bin/sh
echo "tunica $*" | tee -a "$CALLS"; exit "${RUN_STATUS:-3}"'
export PATH="$here/bin:$PATH"

fail() {
  printf 'FAILED: %s\n--- output\n%s\n--- calls\n' "$1" "${output:-}"
  cat "$CALLS"
  exit 1
}
# expect STATUS COMMAND…: runs it and leaves what it wrote in $output.
expect() {
  local wanted=$1 status=0
  shift
  output=$("$@" 2>&1) || status=$?
  ((status == wanted)) || fail "exit status $status, expected $wanted"
}
output_has() { [[ $output == *"$1"* ]] || fail "the output lacks: $1"; }
called() { grep -qxF -- "$1" "$CALLS" || fail "never called: $1"; }

case $2 in
  installs_only_what_is_missing)
    export MISSING="libfmt-dev cmake"
    expect 0 "$here/bootstrap" build
    called "apt-get -q update"
    called "apt-get -q install -y --no-install-recommends cmake libfmt-dev"
    ;;
  installs_nothing_when_nothing_is_missing)
    expect 0 "$here/bootstrap" build
    ! grep -q apt-get "$CALLS" || fail "apt-get was called"
    called "cmake --preset release"
    ;;
  says_what_to_install_without_root_and_sudo)
    export MISSING="libfmt-dev"
    rm "$here/bin/sudo"
    # A path on which there is no sudo, whatever this machine has.
    for tool in bash env readlink dirname cat; do ln -s "$(command -v "$tool")" "$here/bin/$tool"; done
    as_nobody=()
    ((EUID != 0)) || as_nobody=("$(command -v setpriv)" --reuid 65534 --regid 65534 --clear-groups)
    PATH="$here/bin" expect 1 "${as_nobody[@]}" "$here/bootstrap" build
    output_has "missing packages: libfmt-dev"
    output_has "run as root: apt-get install libfmt-dev"
    ! grep -q . "$CALLS" || fail "nothing should have been called"
    ;;
  shows_the_messages_of_a_failed_configuration)
    pretend cmake <<<'echo "Could not find Ceres"; exit 1'
    expect 1 "$here/bootstrap" build
    output_has "Could not find Ceres"
    output_has "cmake could not configure the build"
    ;;
  shows_how_far_the_build_is)
    pretend cmake <<<'[[ $1 != --build ]] || printf "[%s/20] Building CXX object x.o\n" {1..20}'
    expect 0 "$here/bootstrap" build
    output_has "building: step 2 of 20, 10 %"
    output_has "building: step 20 of 20, 100 %"
    [[ $output != *"Building CXX"* && $output != *"step 3 of"* ]] || fail "more than a line every tenth"
    ;;
  shows_what_a_failed_step_printed)
    pretend cmake <<<'[[ $1 != --build ]] || { printf "[1/3] a.o\nFAILED: b.o\nb.cpp:1: error: no\n[2/3] c.o\n"; exit 1; }'
    expect 1 "$here/bootstrap" build
    output_has "b.cpp:1: error: no"
    output_has "the build failed; the step that failed is above"
    ;;
  passes_arguments_and_exit_status_of_a_run_through)
    cd / && touch "$here/mine.json"
    expect 3 "$here/bootstrap" run "$here/mine.json" -j 2
    output_has "tunica run $here/mine.json -j 2"
    expect 3 "$here/bootstrap" run --seed 7
    output_has "tunica run $here/examples/lamb_aorta/experiment.json --seed 7"
    ;;
  builds_what_a_first_result_needs_before_it_and_the_rest_after_it)
    RUN_STATUS=1 expect 1 "$here/bootstrap" run
    grep -oE -- "--target .*|^tunica run" "$CALLS" >"$here/order"
    diff - "$here/order" <<<$'--target first_result\ntunica run\n--target product' || fail "another order"
    output_has "now building the rest"
    : >"$CALLS" && touch "$here/mine.json" && RUN_STATUS=1 expect 1 "$here/bootstrap" run "$here/mine.json"
    grep -q -- "--target first_result every_plugin" "$CALLS" || fail "an own experiment may need any plugin"
    for status in 2 3 130; do
      : >"$CALLS" && RUN_STATUS=$status expect $status "$here/bootstrap" run
      ! grep -q "target product" "$CALLS" || fail "went on to build after status $status"
    done
    ;;
  keeps_the_status_of_a_run_where_the_rest_cannot_be_built)
    pretend cmake <<<'[[ $* != *"--target product"* ]] || { printf "FAILED: b.o\nb.cpp:1: error: no\n"; exit 1; }'
    for status in 0 1; do
      RUN_STATUS=$status expect $status "$here/bootstrap" run
      output_has "b.cpp:1: error: no"
      output_has "the result stands; what failed is the build of the other verbs"
    done
    ;;
  refuses_a_missing_experiment_and_an_unknown_command)
    expect 2 "$here/bootstrap" run nowhere.json
    output_has "no experiment file 'nowhere.json'"
    expect 2 "$here/bootstrap" tset
    output_has "unknown command 'tset'"
    output_has "usage: ./bootstrap run"
    ;;
  ends_with_the_verdict_of_the_tests)
    expect 0 "$here/bootstrap" test
    [[ ${output##*$'\n'} == "$CTEST_OUTPUT" ]] || fail "the last line is no verdict"
    export CTEST_STATUS=8 CTEST_OUTPUT="86% tests passed, 1 tests failed out of 7"
    expect 8 "$here/bootstrap" test
    [[ ${output##*$'\n'} == "$CTEST_OUTPUT" ]] || fail "the last line is no verdict"
    ;;
  installs_the_tools_of_an_analysis_and_passes_its_arguments)
    mkdir "$here/bench"
    install -m 755 /dev/stdin "$here/bench/analyse.py" <<<'#!/bin/sh
echo "analyse $*"; exit 1'
    export MISSING="cppcheck"
    expect 1 "$here/bootstrap" analyse cppcheck -j 1
    called "apt-get -q install -y --no-install-recommends cppcheck"
    output_has "analyse cppcheck -j 1"
    ;;
  does_not_take_silence_for_success)
    export CTEST_OUTPUT="No tests were found!!!"
    expect 1 "$here/bootstrap" test
    output_has "ctest gave no verdict"
    ;;
  *) fail "no case '$2'" ;;
esac
