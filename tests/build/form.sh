#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: form.sh CLANG-FORMAT SOURCE
# Every C++ file has the form that clang-format gives it with .clang-format; of version 14, since
# others break lines elsewhere.
set -euo pipefail
format=$1
cd "$2"
"$format" --version | grep -q 'version 14\.' || { echo "$format is not version 14"; exit 1; }
mapfile -t files < <(find geometry dem verify bench tests -name '*.[ch]pp' | sort)
[ ${#files[@]} -gt 0 ] || { echo "no file found: this test cannot fail"; exit 1; }
# A copy is mended and compared: --dry-run refuses the right end of an inline namespace.
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp --parents .clang-format "${files[@]}" "$copy"
(cd "$copy" && "$format" -i "${files[@]}")
bad=()
for file in "${files[@]}"; do
  cmp -s "$file" "$copy/$file" || bad+=("$file")
done
[ ${#bad[@]} -eq 0 ] || { echo "mend with: $(basename "$format") -i ${bad[*]}"; exit 1; }
