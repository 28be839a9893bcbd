#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: fresh_root.sh ARCHITECTURE DIRECTORY [PACKAGE ...]
# A fresh Debian 12 with these packages, from the archive that this machine's own come from; the source
# tree comes in at /tangency. Needs root, and mmdebstrap of .ci/setup long.
set -euo pipefail
architecture=$1 root=$2
shift 2
[ "$(id -u)" = 0 ] || { echo "fresh_root.sh: only root may make and enter another root"; exit 2; }
archive=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
          awk '$2 == "bookworm" { print $1; exit }')
[ -n "$archive" ] || { echo "fresh_root.sh: apt-get knows no archive of Debian 12 (bookworm)"; exit 2; }
rm -rf "$root"
packages=$(IFS=,; echo "$*")
# What foreign programs would run by is not asked for: an i386 needs nothing on an amd64.
mmdebstrap --quiet --mode=root --variant=minbase --skip=check/qemu --architectures="$architecture" \
           ${packages:+--include="$packages"} bookworm "$root" "$archive"
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
mkdir "$root/tangency"
(cd "$source" && git ls-files --cached --others --exclude-standard -z | tar c --null -T - ) |
  tar x -C "$root/tangency"
