#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: consumer.sh BUILD SOURCE WORK
# Installs BUILD, moves what was installed elsewhere, and uses it there as strangers do: by
# find_package() with each component and with none, by pkg-config, in a plug-in, by an old dialect.
set -euo pipefail
build=$1 source=$2 work=$3
consumers=$source/tests/consumer
rm -rf "$work"
mkdir -p "$work"
work=$(cd "$work" && pwd)
cmake --install "$build" --prefix "$work/made" >"$work/installed"
mv "$work/made" "$work/prefix"
prefix=$work/prefix
kind=shared
[ -z "$(find "$prefix" -name libtangency_geometry.a)" ] || kind=static
# shellcheck source=tests/build/matrix.sh
. "$source/tests/build/matrix.sh"

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name tangency-geometry.pc)")
cxx=${CXX:-c++}
eigen=$(pkg-config --cflags-only-I eigen3 | sed 's/-I/-isystem /g')

relocated() {
  for place in "$source" "$build" "$work/made"; do
    if grep -rlF -- "$place" "$prefix"; then echo "these name $place"; exit 1; fi
  done
  # Its tools run where it lies now, and find the corpora there.
  [ "$("$prefix/bin/tangency" --version)" = "tangency $(pkg-config --modversion tangency-geometry)" ]
  "$prefix/bin/tangency-verify" grade --tool "$prefix/bin/tangency contact" --corpus touching >/dev/null
}

# What lies where people and programs look for it.
all_is_there() {
  for file in include/tangency/{version,geometry/gap,dem/simulation,dem/micromechanics/fabric}.hpp \
              include/tangency/verify/oracles/gap.hpp share/tangency/scenes/growth-1000.toml \
              share/tangency/corpora/touching.csv share/man/man1/tangency{,-dem,-verify}.1 \
              share/bash-completion/completions/tangency{,-dem,-verify} \
              include/tangency.{h,f90} share/doc/tangency/LICENSE share/doc/tangency/LICENSES/{MIT,GPL-3.0-or-later}.txt; do
    [ -s "$prefix/$file" ] || { echo "$file is not installed"; exit 1; }
  done
  [ -s "$prefix/lib/python3/dist-packages/tangency/__init__.py" ] || { echo "the Python package is not installed"; exit 1; }
  for program in tangency{,-dem,-verify}; do
    [ -s "$prefix/share/zsh/site-functions/_$program" ] || [ -s "$prefix/share/zsh/vendor-completions/_$program" ] ||
      { echo "zsh's completion of $program is not installed"; exit 1; }
  done
}

# Every header with all that it includes. Without its own folder no other copy is found.
headers() {
  (cd "$prefix/include" && find tangency -name '*.hpp' | sort | sed 's/.*/#include <&>/') >"$work/all.cpp"
  # shellcheck disable=SC2086  # options, one a word
  "$cxx" -std=c++20 -fsyntax-only -Wall -Wextra -Werror $eigen -I"$prefix/include" "$work/all.cpp"
}

# A user whose flags ask for fused multiply-adds gets them in his own code, and is answered.
all_components() {
  local flags="-O2 -ffp-contract=fast"
  [ "$(uname -m)" != x86_64 ] || flags="$flags -mfma"
  cmake -G Ninja -S "$consumers" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags"
  cmake --build "$work/build"
  if [ "$(uname -m)" != x86_64 ] || grep -qw fma /proc/cpuinfo; then
    "$work/build/consumer" fused
  else
    objdump -d "$work/build/CMakeFiles/consumer.dir/multiply_add.cpp.o" | grep -q vfm
  fi
  for program in fabric simulate oracle; do "$work/build/$program"; done
}

# What the library throws is caught behind a border that shows no type.
plugin() {
  "$work/build/loader" "$work/build/plugin.so"
  local shown
  shown=$(nm -D --defined-only "$work/build/plugin.so" | awk '$2 == "T" { print $3 }' | sort | xargs)
  [ "$shown" = "plugin_catches plugin_gap" ] || { echo "the plug-in shows: $shown" | head -c 2000; exit 1; }
}

# Each component alone, and what is said of those that are not there.
components() {
  mkdir -p "$work/partial"
  cp -r "$prefix/." "$work/partial"
  local package static=OFF
  package=$(cd "$work/partial" && find . -name tangencyConfig.cmake -printf '%h')
  rm "$work/partial/$package"/tangency-{dem,micromechanics,verify}*.cmake
  [ $kind = shared ] || static=ON
  cmake -G Ninja -S "$consumers/components" -B "$work/components" -DCMAKE_PREFIX_PATH="$prefix" \
        -DPARTIAL="$work/partial/$package" -DSTATIC=$static
}

by_pkg_config() {
  pkg-config --exists tangency-dem tangency-micromechanics
  # shellcheck disable=SC2046  # options, one a word
  "$cxx" -std=c++20 "$consumers/embedding/contacts.cpp" "$consumers/embedding/main.cpp" \
    $(pkg-config --cflags --libs tangency-geometry) -o "$work/by_pkg_config"
  LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$work/by_pkg_config"
}

# In an older dialect the first error says what is wrong.
old_dialect() {
  # shellcheck disable=SC2046  # options, one a word
  if "$cxx" -std=c++17 -fsyntax-only $(pkg-config --cflags tangency-geometry) \
       "$consumers/embedding/contacts.cpp" 2>"$work/cxx17"; then
    echo "C++17 is enough: this test is out of date"; exit 1
  fi
  grep -m 1 'error' "$work/cxx17" | grep 'tangency needs C++20' || { head "$work/cxx17"; exit 1; }
}

# The interface in C, by CMake and by pkg-config.
c89() {
  cmake -G Ninja -S "$consumers/c" -B "$work/c" -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build "$work/c"
  "$work/c/contact"
  # shellcheck disable=SC2046  # options, one a word
  "${CC:-cc}" -std=c89 -pedantic-errors "$consumers/c/contact.c" $(pkg-config --cflags --libs tangency-c) \
    -o "$work/c_by_pkg_config"
  LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$work/c_by_pkg_config"
}

# Its module of Fortran is a source: each compiler has modules of its own.
fortran() {
  # shellcheck disable=SC2046  # options, one a word
  gfortran -std=f2018 -J "$work" "$prefix/include/tangency.f90" "$consumers/fortran/contact.f90" \
    $(pkg-config --libs tangency-c) -o "$work/by_fortran"
  LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$work/by_fortran"
}

# The package as Debian's Python finds it, and the library as its loader does.
python() {
  PYTHONPATH=$prefix/lib/python3/dist-packages LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") /usr/bin/python3 - <<'PY'
import tangency

found = tangency.contact([0, 0, 0, 1, 2, 3, 1, 0, 0, 0], [0, 0, 7, 3, 2, 1, 1, 0, 0, 0])
print(found.gap, found.normal)
assert found.gap == 3
PY
}

# What a shared library shows: names of this project that are public.
shows() {
  local library name
  export LC_ALL=C
  for name in geometry micromechanics dem; do
    library=$(find "$prefix" -name "libtangency_$name.so")
    readelf -d "$library" | grep -qE 'SONAME.*\.so\.[0-9]+\.[0-9]+\]' || { echo "$library: soname"; exit 1; }
    nm -D --defined-only "$library" | awk '{ print $3 }' | c++filt >"$work/shown"
    grep -q 'tangency::' "$work/shown" || { echo "$library shows nothing: this test cannot fail"; exit 1; }
    # Asked by the program `tangency`: geometry/exported.map.
    if grep -v 'tangency::' "$work/shown" || grep -E '^(tangency::v0::|.* for tangency::v0::)(detail|exact)::' "$work/shown" |
         grep -vE 'exact::(classify_form|quadric_form|common_exponent)\('; then
      echo "$library shows these"
      exit 1
    fi
    sed 's/tangency::v0::/tangency::/g' "$work/shown" | sort -u >"$work/shown_names"
    sed -n "s/^libtangency_$name: //p" "$source/tests/build/public_symbols" | sort -u |
      comm -23 - "$work/shown_names" >"$work/not_shown"
    [ ! -s "$work/not_shown" ] || { echo "$library does not show"; cat "$work/not_shown"; exit 1; }
  done
}

consumer "relocated: no file names where it was made" relocated
consumer "documents, manual pages, completions, scenes, corpora" all_is_there
consumer "every header, with warnings as errors" headers
consumer "find_package() of all, flags of its own" all_components
consumer "find_package() of each component, and of none" components
consumer "plug-in by dlopen(), hidden names, exceptions" plugin
consumer "pkg-config" by_pkg_config
consumer "C++17 is told what it lacks" old_dialect
consumer "C89 by find_package() and pkg-config" c89
consumer "Fortran" fortran
[ $kind = static ] || consumer "Python" python
[ $kind = static ] || consumer "soname, and public names alone" shows
exit $failed
