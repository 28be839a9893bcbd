#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: descriptions.sh PROGRAM ...
# What the programs say of themselves, as their users meet it: bash completes their words, their manual
# pages name every option that their help names, and man and zsh, where they are installed, read them.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# completions PROGRAM WORD ...: of the last word.
completions() {
  local program=$1
  shift
  bash -c 'source "$1"; shift; name=$1; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
           function=_${name//-/_}; "$function"; echo "${COMPREPLY[*]}"' - "$work/bash" "$program" "$@"
}

for program in "$@"; do
  name=$(basename "$program")
  "$program" --describe man >"$work/$name.1"
  "$program" --describe bash >"$work/bash"
  "$program" --describe zsh >"$work/_$name"
  subcommands=$("$program" --help | awk '/^Subcommands:/ { there = 1; next } /^[^ ]/ { there = 0 }
                                         there && /^  [a-z]/ { print $1 }')
  [ -n "$subcommands" ] || { echo "$name: no subcommand: this test cannot fail"; exit 1; }
  # shellcheck disable=SC2086  # words
  [ "$(completions "$name" "")" = "$(echo $subcommands)" ] || { echo "$name: no subcommands by bash"; exit 1; }
  for subcommand in $subcommands; do
    [[ " $(completions "$name" "${subcommand:0:2}") " == *" $subcommand "* ]] ||
      { echo "bash does not complete $name ${subcommand:0:2}"; exit 1; }
    options=$("$program" "$subcommand" --help | awk '/^Options:/ { there = 1; next } /^[^ ]/ { there = 0 }
                there && /^  -/ { n = split($1, names, ","); for (i = 1; i <= n; ++i) print names[i] }')
    section=$(awk -v of=".SH \"${name^^} ${subcommand^^}\"" '/^\.SH/ { there = $0 == of } there' "$work/$name.1" |
              sed 's/\\-/-/g')
    for option in $options; do
      grep -qE -- "^.fB(-h, )?$option.fR" <<< "${section//\\/.}" ||
        [ "$option" = -h ] || { echo "manual of $name $subcommand: no $option"; exit 1; }
      [[ " $(completions "$name" "$subcommand" "${option:0:3}") " == *" $option "* ]] ||
        { echo "bash does not complete $name $subcommand ${option:0:3} to $option"; exit 1; }
      grep -qF -- "'$option[" "$work/_$name" || { echo "zsh: no $option"; exit 1; }
    done
  done
  if command -v lexgrog >/dev/null; then
    lexgrog "$work/$name.1" >/dev/null
    complaints=$(LC_ALL=C MANROFFOPT='-ww' man --warnings -l "$work/$name.1" 2>&1 >/dev/null |
                 grep -vE "can't (break|adjust) line|cannot (break|adjust) line" || true)
    [ -z "$complaints" ] || { echo "$complaints"; exit 1; }
  fi
  if command -v zsh >/dev/null; then
    zsh -n "$work/_$name"
  fi
  echo "$name: $(wc -w <<< "$subcommands") subcommands"
done
