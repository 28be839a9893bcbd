#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Fetches the upstream archive of a source package of Debian. No deb-src line is needed: apt reads the
# system's own sources, as sources of source packages, into a folder of its own, and checks signatures
# and sums as always. Needs the network once.
# Usage: source_package.sh FOLDER PACKAGE[=VERSION] [RELEASE]   RELEASE: sid, say; else the system's own
set -euo pipefail
folder=${1:?the folder that the archives go to}
package=${2:?the source package}
release=${3:-}

apt=$(mktemp -d)
trap 'rm -rf "$apt"' EXIT
chmod 755 "$apt"
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$folder"
cp /etc/apt/trusted.gpg "$apt" 2>/dev/null || true
keys=$(find /usr/share/keyrings /etc/apt/trusted.gpg.d -name 'debian-archive-*keyring.gpg' -print -quit)
apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT) $(ORIGIN)' 'Identifier: Packages' |
  sort -u | while read -r site suite component origin; do
    if [ -n "$release" ]; then
      # Updates and security are archives of their own: sid stands beside the release itself.
      [ "$origin" = Debian ] && [[ "$site $suite" != *security* ]] && suite=$release || continue
    fi
    echo "deb-src ${keys:+[signed-by=$keys]} $site $suite $component"
  done | sort -u >"$apt/sources.list"
options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
         -o "Dir::State::Lists=$apt/lists" -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=)
# What is installed is of the system's own release: it does not say which version another one has.
[ -z "$release" ] || options+=(-o Dir::State::status=/dev/null)
# A source of the machine that is none of Debian's may have no source packages: the package decides.
apt-get "${options[@]}" update >"$apt/log" 2>&1 || true
(cd "$folder" && apt-get "${options[@]}" source --tar-only --download-only "$package" >>"$apt/log" 2>&1) || {
  cat "$apt/log" >&2
  echo "$package${release:+ of $release}: apt finds no source package of it" >&2
  exit 1
}
