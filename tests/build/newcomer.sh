#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: newcomer.sh SOURCE WORK
# A newcomer's way, timed: in a fresh Debian 12 with git alone, what README's sections say from a clone of
# HEAD to a contact of one's own. The times stand beside their bars and decide nothing: machines differ.
set -euo pipefail
source=$(cd "$1" && pwd) work=$2
rm -rf "$work"
mkdir -p "$work"
work=$(cd "$work" && pwd)
status=0

# path HEADING BAR: the first block of shell commands in the section, and the seconds that it may take.
path() {
  local heading=$1 bar=$2 root=$work/root start
  awk -v heading="## $heading" '/^## / { there = $0 == heading; next }
    there && /^```sh$/ { inside = 1; next }
    inside && /^```$/ { exit }
    inside' "$source/README.md" >"$work/commands"
  if [ ! -s "$work/commands" ]; then
    echo "$heading: README has no commands"
    status=1
    return
  fi
  "$source/tests/build/fresh_root.sh" "$(dpkg --print-architecture)" "$root" git ca-certificates
  git clone --quiet --bare "$source" "$root/tangency.git"
  { echo 'set -e; export HOME=/root; cd'
    echo 'git -c safe.directory="*" clone --quiet /tangency.git tangency; cd tangency'
    echo 'set -x'
    cat "$work/commands"; } >"$root/way"
  start=$SECONDS
  if chroot "$root" env LC_ALL=C.UTF-8 bash /way >"$work/said" 2>&1 </dev/null; then
    echo "$heading: $((SECONDS - start)) s of $bar from the clone to"
    tail -n 3 "$work/said"
    rm -rf --one-file-system "$root"
  else
    echo "$heading: FAILED after $((SECONDS - start)) s:"
    tail -n 20 "$work/said"
    status=1
  fi
}

path "From C++" 300
path "From Python" 180
exit $status
