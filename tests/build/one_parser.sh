#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: one_parser.sh SOURCE
# CLI11 takes seconds to compile: one source includes it (docs/decisions/0004-argument-parsing.md).
set -euo pipefail
cd "$1"
found=$(grep -rlE '#include *<CLI/' --include='*.?pp' bench dem geometry tests verify)
[ "$found" = geometry/tables/command_line.cpp ] && exit
echo "CLI11 is included by:"
echo "$found"
exit 1
