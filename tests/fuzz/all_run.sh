#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: all_run.sh FUZZ TARGET:COUNT ...
# The gate names every target that there is, and no other.
set -euo pipefail
fuzz=$1
shift
diff <("$fuzz" --list | awk '{ print $1 }' | sort) <(printf '%s\n' "$@" | sed 's/:.*//' | sort)
