#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Copies headers of LAMMPS that Debian's package liblammps-dev lacks out of Debian's source package of
# the same version. No deb-src line is needed: apt reads the system's own sources, as sources of source
# packages, into a folder of its own, and checks signatures and sums as always. Needs the network once.
# Usage: source_headers.sh FOLDER HEADER ...
set -euo pipefail
folder=${1:?the folder that the headers go to}
shift
complete() {
  for header in "$@"; do [ -s "$folder/$header" ] || return 1; done
}
if complete "$@"; then exit 0; fi
source=$(dpkg-query -W -f '${source:Package}=${source:Version}' liblammps-dev)

apt=$(mktemp -d)
trap 'rm -rf "$apt"' EXIT
chmod 755 "$apt"
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
cp /etc/apt/trusted.gpg "$apt" 2>/dev/null || true
keys=$(find /usr/share/keyrings /etc/apt/trusted.gpg.d -name 'debian-archive-*keyring.gpg' -print -quit)
apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' |
  sort -u | while read -r site release component; do
    echo "deb-src ${keys:+[signed-by=$keys]} $site $release $component"
  done >"$apt/sources.list"
options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
         -o "Dir::State::Lists=$apt/lists" -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=)
# A source of the machine that is none of Debian's may have no source packages: lammps decides.
apt-get "${options[@]}" update >"$apt/log" 2>&1 || true
(cd "$apt" && apt-get "${options[@]}" source --download-only "$source" >>"$apt/log" 2>&1) || {
  cat "$apt/log" >&2
  echo "$source: apt finds no source package of it: unpack its source elsewhere and set" \
       "TANGENCY_LAMMPS_HEADERS to its folder src" >&2
  exit 1
}
mkdir -p "$apt/unpacked" "$folder"
tar -xf "$apt"/*.orig.tar.* -C "$apt/unpacked" --wildcards '*/src/*.h'
for header in "$@"; do
  found=$(find "$apt/unpacked" -path "*/src/$header" -print -quit)
  [ -n "$found" ] || { echo "$header: not in $source" >&2; exit 1; }
  mkdir -p "$(dirname "$folder/$header")"
  cp "$found" "$folder/$header"
done
