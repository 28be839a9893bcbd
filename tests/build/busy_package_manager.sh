#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Usage: busy_package_manager.sh SETUP
# .ci/setup beside a package manager that holds a lock twice and then lets go, and beside one that
# fails. Everything that it would install with is a stand-in, and so is its pause.
set -euo pipefail
setup=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
stand_in() { printf '#!/bin/sh\n%s\n' "$2" >"$work/$1"; chmod +x "$work/$1"; }
stand_in dpkg-query 'exit 1'
stand_in id 'echo 0'
stand_in sleep "echo >>'$work/pauses'"
stand_in apt-get "
  echo \"\$@\" >>'$work/calls'
  case \$(wc -l <'$work/calls') in
    1) echo 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)' ;;
    3) echo 'E: Could not get lock /var/cache/apt/archives/lock. It is held by process 7' ;;
    *) exit 0 ;;
  esac >&2
  exit 100"
PATH="$work:$PATH" "$setup" demo >"$work/out"
[ "$(cut -d ' ' -f 3 "$work/calls" | tr '\n' ' ')" = "update update install install " ]
[ "$(wc -l <"$work/pauses")" = 2 ]
[ "$(grep -c 'Could not get lock .*/lock' "$work/out")" = 2 ]

stand_in apt-get 'echo "E: Unable to locate package" >&2; exit 100'
status=0
PATH="$work:$PATH" "$setup" demo >"$work/out" 2>"$work/err" || status=$?
[ "$status" = 1 ]
grep -q 'Unable to locate package' "$work/err"
grep -q 'apt-get update failed' "$work/err"
