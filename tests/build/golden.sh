#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: golden.sh FILE GENERATOR [ARGUMENT ...]
# The committed file is byte for byte what its generator writes.
set -euo pipefail
file=$1
shift
"$@" | cmp - "$file"
