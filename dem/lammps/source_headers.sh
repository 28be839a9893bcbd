#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Copies headers of LAMMPS that Debian's package liblammps-dev lacks out of Debian's source package of
# the same version: source_package.sh. Needs the network once.
# Usage: source_headers.sh FOLDER HEADER ...
set -euo pipefail
folder=${1:?the folder that the headers go to}
shift
complete() {
  for header in "$@"; do [ -s "$folder/$header" ] || return 1; done
}
if complete "$@"; then exit 0; fi
source=$(dpkg-query -W -f '${source:Package}=${source:Version}' liblammps-dev)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$(dirname "${BASH_SOURCE[0]}")/source_package.sh" "$work" "$source" || {
  echo "Unpack its source elsewhere and set TANGENCY_LAMMPS_HEADERS to its folder src" >&2
  exit 1
}
mkdir -p "$work/unpacked" "$folder"
tar -xf "$work"/*.orig.tar.* -C "$work/unpacked" --wildcards '*/src/*.h'
for header in "$@"; do
  found=$(find "$work/unpacked" -path "*/src/$header" -print -quit)
  [ -n "$found" ] || { echo "$header: not in $source" >&2; exit 1; }
  mkdir -p "$(dirname "$folder/$header")"
  cp "$found" "$folder/$header"
done
