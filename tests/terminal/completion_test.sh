#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# completion_test.sh TUNICA SCRIPT: command lines are completed as readline asks a completion function to do it.
set -u
tunica=$1
# shellcheck source=/dev/null
source "$2" || exit 1

failures=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
mkdir results 'two words'
touch experiment.json extended.json strip.csv 'two words/first.json'

[[ $(complete -p tunica) == 'complete -F _tunica tunica' ]] || { echo "tunica has no completion: $(complete -p tunica)"; exit 1; }

# offers WORD...: what is offered for the last word.
offers() {
  COMP_WORDS=("$tunica" "$@") COMP_CWORD=$# COMPREPLY=()
  _tunica
  local IFS=$'\n'
  sort -u <<<"${COMPREPLY[*]}" | paste -sd ' '
}

# expect "OFFERED" WORD...
expect() {
  local wanted=$1 found
  shift
  found=$(offers "$@")
  [[ $found == "$wanted" ]] && return
  printf 'tunica %s<TAB>\n  offers   %s\n  expected %s\n' "$*" "$found" "$wanted"
  ((++failures))
}

# expect_all "WORD WORD" WORD...: these are among what is offered.
expect_all() {
  local wanted=$1 word found
  shift
  found=" $(offers "$@") "
  for word in $wanted; do
    [[ $found == *" $word "* ]] && continue
    printf 'tunica %s<TAB>\n  offers  %s\n  without %s\n' "$*" "$found" "$word"
    ((++failures))
  done
}

# Every verb that the help lists.
verbs=$("$tunica" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
[[ $(wc -w <<<"$verbs") -ge 12 ]] || { echo "the help lists these verbs only: $verbs"; exit 1; }
expect_all "$verbs" ''
expect 'describe' desc
expect 'certify check cohort completion' c
expect_all '--output --threads --resume --seed --bootstrap --quiet --plugin-path' run experiment.json --
# Every option that the help of a verb lists.
for verb in $verbs; do
  [[ $verb == plugin ]] && continue  # has verbs of its own
  expect_all "$("$tunica" "$verb" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | paste -sd ' ')" "$verb" --
done
expect 'check new' plugin ''
expect '--profiles' run experiment.json --pro
expect '' run experiment.json --profi=

# Files: experiments are JSON, results are folders, and a folder may lead to an experiment.
expect 'experiment.json extended.json results two words' run ''
expect 'experiment.json' check exp
expect 'results two words' report ''
expect 'results two words' report results ''
expect 'results' run experiment.json -o res
expect 'results' run experiment.json --output = res
expect 'results two words' run experiment.json --output =
expect 'two words/first.json' run 'two\ words/'
expect '' simulate experiment.json --noise ''

# Names come from the plugins.
loading=(--allow-world-writable-plugins)
expect 'gho' "${loading[@]}" describe gh
expect 'uniaxial' "${loading[@]}" describe unia
expect 'fibre_dispersion fibre_recruitment' "${loading[@]}" diagnose experiment.json --mechanisms fibre_
expect 'force_offset,fibre_dispersion force_offset,fibre_recruitment' \
  "${loading[@]}" diagnose experiment.json --mechanisms force_offset,fibre_
expect_all 'models tests optimizers mechanisms' list ''
expect 'mechanisms' list mech
expect 'bash zsh' completion ''

((failures == 0)) && echo "all command lines were completed as expected"
exit $((failures > 0))
