#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Fetches and unpacks what the plugin of docs/lammps.md is built with, of Debian: a LAMMPS of today and
# the Highway of today (sid), and GMP. Needs the network once.
# Usage: plugin_sources.sh FOLDER    FOLDER/lammps, FOLDER/highway and FOLDER/gmp are made
set -euo pipefail
folder=$(realpath -m "${1:?the folder that the sources go to}")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
fetch() { # NAME MARK [RELEASE]: MARK is a file that its source has
  local name=$1 mark=$2 work top
  [ ! -f "$folder/$name/$mark" ] || return 0
  echo "Fetching the source of $name"
  mkdir -p "$folder"
  work=$(mktemp -d -p "$folder")
  trap 'rm -rf "$work"' RETURN
  "$here/source_package.sh" "$work" "$name" ${3:+"$3"}
  mkdir "$work/unpacked"
  tar -xf "$work"/*.orig.tar.* -C "$work/unpacked"
  # Some archives hold one folder, some none.
  top=$(dirname "$(find "$work/unpacked" -maxdepth 3 -path "*/$mark" -print -quit)")
  top=${top%/"$(dirname "$mark")"}
  rm -rf "${folder:?}/$name"
  mv "$top" "$folder/$name"
}
fetch lammps src/lammps.h sid
fetch highway CMakeLists.txt sid
fetch gmp configure
# Debian's archive is without GMP's manual, which its configure and its Makefile name.
if [ ! -f "$folder/gmp/doc/Makefile.in" ]; then
  mkdir -p "$folder/gmp/doc"
  printf 'all install:\n' >"$folder/gmp/doc/Makefile.in"
fi
