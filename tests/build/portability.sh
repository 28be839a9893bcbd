#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: portability.sh SOURCE WORK BUILD [ROW ...]
# The same answers from other compilers, options and processors, as a table. For each row the kernel,
# the simulator, their tools and tests of the kernel are built; the tests run; the tool answers every
# corpus; two small scenes run with --reproducible. A row is right if the tests pass, the
# tangency-verify of BUILD finds no wrong answer and no gap beyond its error, what is exact in the
# answers (relations, types, crossings, hits, neighbours) is that of BUILD's tangency, and states and
# files of the simulator are those of BUILD's tangency-dem, to the bit: `equal`. Eigen adds the products
# of a quaternion or of a matrix in another order where it has no vectors of two doubles: the row
# `scalar` alone may have other states than BUILD, and s390x has to have those of BUILD or of `scalar`.
# Foreign programs run under qemu-user, with the libraries of a Debian 12 that is unpacked once in WORK.
# The packages are those of .ci/setup portability.
set -euo pipefail
source=$(cd "$1" && pwd) build=$(cd "$3" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
shift 3
declare -A tells=(
  [gcc-debug]="g++, nothing optimised" [gcc-o3-native]="g++, -O3 -march=native"
  [clang]="clang++, Release" [scalar]="g++, Eigen without vectors" [i386]="32-bit integers, pointers" [arm64]="64-bit ARM"
  [s390x]="big-endian, 64-bit")
rows=(gcc-debug gcc-o3-native clang scalar i386 arm64 s390x)
chosen=("$@")
[ ${#chosen[@]} -gt 0 ] || chosen=("${rows[@]}")
for row in "${chosen[@]}"; do
  [ -n "${tells[$row]:-}" ] || { echo "$row: none of ${rows[*]}" >&2; exit 2; }
done

# libraries ROOT ARCHITECTURE: what a row links, from this machine's own archive, unpacked, not set up.
libraries() {
  local archive packages
  [ ! -e "$1/usr/whole" ] || return 0
  archive=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
            awk '$2 == "bookworm" { print $1; exit }')
  [ -n "$archive" ] || { echo "apt-get knows no archive of Debian 12 (bookworm)" >&2; return 1; }
  packages=$(awk '!/^#/ && ($1 == "library" || $1 == "demo") && $2 ~ /^(lib|zlib|nlohmann)/ { print $2 }' \
             "$source/.ci/packages" | paste -sd,)
  rm -rf --one-file-system "$1"
  mmdebstrap --quiet --variant=extract --skip=check/qemu --architectures="$2" \
             --include="libc6-dev,libstdc++-12-dev,libgtest-dev,librapidcheck-dev,$packages" \
             bookworm "$1" "$archive"
  touch "$1/usr/whole"
}

# configure ROW: a build in WORK/b-ROW; sets `run`, what its programs are begun by.
configure() {
  local triple='' emulator='' off
  local options=(-G Ninja -S "$source" -B "$work/b-$1" -D TANGENCY_PORTABILITY=ON -D TANGENCY_INSTALL=OFF)
  for off in VERIFY TESTS BENCH PYTHON C; do options+=(-D TANGENCY_BUILD_$off=OFF); done
  run=()
  case $1 in
    gcc-debug) options+=(-D CMAKE_BUILD_TYPE=Debug -D TANGENCY_OPTIMIZED_KERNEL=OFF) ;;
    gcc-o3-native) options+=(-D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS_RELEASE="-O3 -march=native -DNDEBUG") ;;
    clang) options+=(-D CMAKE_BUILD_TYPE=Release -D CMAKE_C_COMPILER=clang-14 -D CMAKE_CXX_COMPILER=clang++-14) ;;
    scalar) options+=(-D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS="-DEIGEN_DONT_VECTORIZE") ;;
    # The arithmetic of SSE2, as on every 64-bit x86: the x87's rounds to 64 bits, and the headers refuse it.
    i386) triple=i686-linux-gnu emulator=i386
          options+=(-D CMAKE_CXX_FLAGS="-msse2 -mfpmath=sse") ;;
    arm64) triple=aarch64-linux-gnu emulator=aarch64 ;;
    s390x) triple=s390x-linux-gnu emulator=s390x ;;
  esac
  if [ -n "$triple" ]; then
    libraries "$work/$1" "$1"
    export TANGENCY_TRIPLE=$triple TANGENCY_ROOT=$work/$1
    options+=(-D CMAKE_BUILD_TYPE=Release -D CMAKE_TOOLCHAIN_FILE="$source/tests/build/portability/toolchain.cmake")
    run=("qemu-$emulator" -L "$TANGENCY_ROOT")
  fi
  cmake "${options[@]}"
}

# results PROGRAM...: of tangency-dem, what has to be the same to the bit, a line each: the hashes of the
# states at the end of two small scenes, the bytes of the last one, of a GSD file that is made of the
# state of BUILD, and of the table that is read from this.
results() {
  local scene
  for scene in impact assembly-27; do
    "$@" run "$source/dem/scenes/$scene.toml" --reproducible --quiet --threads 1 --replace \
         --out "$work/scene" >&2
    sed -n 's/^ *"state_hash": "\([0-9a-f]*\)".*/\1/p' "$work/scene/summary.json"
  done
  cksum <"$work/scene/final.state"
  [ -e "$work/expected.state" ] || cp "$work/scene/final.state" "$work/expected.state"
  "$@" export "$work/expected.state" --format gsd --out "$work/sample.gsd" >&2
  "$@" import "$work/sample.gsd" --out "$work/sample.csv" >&2
  cksum <"$work/sample.gsd"
  cksum <"$work/sample.csv"
}

# corpus NAME: adds to `answers`, `wrong` and `other` of row().
corpus() {
  local call exact differing
  case $1 in
    ellipses) call=ellipse exact=1-3 ;;
    quadrics) call=classify exact=1-4 ;;
    neighbours) call=neighbours exact=1-5 ;;
    neighbours-periodic) call="neighbours --periodic 80,16,8" exact=1-5 ;;
    points) call=point exact=1 ;;
    walls) call=wall exact=1,2 ;;
    rays) call=ray exact=1,2 ;;
    times) call=time exact=1,2 ;;
    *) call=contact exact=1,2 ;;
  esac
  "$build/verify/tool/tangency-verify" grade --corpus "$1" --tool "${run[*]} $tool $call" --max-wrong 0 >&2 ||
    wrong=$((wrong + 1))
  # shellcheck disable=SC2086  # a call and its options
  "$build/geometry/tool/tangency" $call <"$source/verify/corpora/$1.csv" | cut -d , -f $exact >"$work/expected"
  # shellcheck disable=SC2086
  "${run[@]}" "$tool" $call <"$source/verify/corpora/$1.csv" | cut -d , -f $exact >"$work/answered"
  [ "$(wc -l <"$work/expected")" -gt 1 ] || { echo "$1: no answer: this check cannot fail" >&2; return 1; }
  answers=$((answers + $(wc -l <"$work/expected") - 1))
  differing=$(diff "$work/expected" "$work/answered" | tee /dev/stderr | grep -c '^[<>]') || true
  other=$((other + differing))
}

# One row: fields of the table to standard output, all else to its log.
row() {
  local tool=$work/b-$1/geometry/tool/tangency tests answers=0 wrong=0 other=0 truth states=equal
  configure "$1" >&2
  cmake --build "$work/b-$1" --target tangency_tool tangency_dem_tool tests_portability >&2
  # Chosen: what runs within some minutes where each instruction is translated. A test that fails is counted,
  # and so is a program that breaks off.
  tests=$({ RC_PARAMS="seed=20261122 max_success=100" "${run[@]}" "$work/b-$1/tests/build/portability/tests_portability" ||
            echo "ended with $?"; } | tee /dev/stderr |
          sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1 passed/p; s/^ *\([0-9]*\) FAILED TEST.*/\1 FAILED/p; s/^ended with /status /p' |
          paste -sd' ')
  for truth in "$source"/verify/corpora/*.truth.csv; do corpus "$(basename "$truth" .truth.csv)"; done
  results "${run[@]}" "$work/b-$1/dem/tool/tangency-dem" >"$work/$1.results"
  if ! diff "$work/expected.results" "$work/$1.results" >&2; then
    states=OTHER
    case $1 in
      scalar) [ "$(tail -n 2 "$work/scalar.results")" != "$(tail -n 2 "$work/expected.results")" ] || states=scalar ;;
      s390x) ! cmp -s "$work/scalar.results" "$work/$1.results" || states=scalar ;;
    esac
  fi
  printf '%s|%s|%s|%s|%s' "$tests" "$answers" "$wrong" "$other" "$states"
}

rm -f "$work/expected.state"
results "$build/dem/tool/tangency-dem" >"$work/expected.results" 2>"$work/expected.log" &&
  [ "$(grep -cE '^([0-9a-f]{16}|[0-9]+ [0-9]+)$' "$work/expected.results")" = 5 ] ||
  { echo "no results of $build: $work/expected.log" >&2; exit 1; }
status=0
line='%-14s %-26s %-12s %8s %8s %7s %-7s %8s\n'
# shellcheck disable=SC2059  # the format is ours
printf "$line" row what tests answers "corpora" other states seconds '' '' '' '' "failed" '' '' ''
for name in "${chosen[@]}"; do
  begin=$SECONDS
  # Not in a condition: there a failing command would not end it.
  set +e
  fields=$(set -e; row "$name" 2>"$work/$name.log")
  ended=$?
  set -e
  IFS='|' read -r tests answers wrong other states <<<"$fields"
  if [ $ended -ne 0 ]; then
    tests="not run" answers='' wrong='' other='' states=''
    echo "$name: not run to its end; the last lines of $work/$name.log:" >&2
    tail -n 5 "$work/$name.log" >&2
  fi
  # shellcheck disable=SC2059
  printf "$line" "$name" "${tells[$name]}" "$tests" "$answers" "$wrong" "$other" "$states" $((SECONDS - begin))
  [[ "$tests|$wrong|$other|$states" =~ ^[0-9]+\ passed\|0\|0\|(equal|scalar)$ ]] || status=1
done
exit $status
