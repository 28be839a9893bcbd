#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: golden.sh GENERATOR FILE
# The committed file is byte for byte what its generator writes.
set -euo pipefail
"$1" | cmp - "$2"
