#!/bin/bash
# The same motion with this program and with general solvers, timed side by side in one process.
#
#   ./tests/bench/compare.sh [REPEATS [REVOLUTIONS]]     default: 5 repeats of 60 revolutions a point; some minutes
#
# Installs what is missing, builds in build-bench/, runs, prints the tables and keeps them in
# tests/bench/comparison.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
case "${1-}" in -*) sed -n '2,7s/^# \{0,1\}//p' tests/bench/compare.sh; [ "$1" = --help ] && exit 0 || exit 2 ;; esac

./jobs/install.sh --bench
build=${RUBATLAS_BENCH_BUILD:-build-bench}
new_tree=()
[ -e "$build/CMakeCache.txt" ] || new_tree=(-G Ninja -DCMAKE_CXX_FLAGS=-g)
cmake -S . -B "$build" "${new_tree[@]}" -DRUBATLAS_BENCH=ON >/dev/null
cmake --build "$build" --target compare --parallel "${RUBATLAS_BENCH_JOBS:-$(nproc)}" >/dev/null

page=tests/bench/comparison.md
processor=$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1)
family=$(sed -n 's/^cpu family\s*: //p' /proc/cpuinfo | head -n 1)
changed=""
git diff --quiet HEAD -- src CMakeLists.txt || changed=", with changes"
{
  echo "# Side by side, as measured"
  echo
  echo "Made by \`./tests/bench/compare.sh $*\` at commit $(git rev-parse --short HEAD)$changed, on one core of"
  echo "$processor (family $family, $(nproc) cores), g++ $(g++ -dumpfullversion), $(date -u +%Y-%m-%d)."
  echo "What the columns mean: [bench](README.md)."
  echo
  "$build/tests/bench/compare" "$@"
} >"$build/comparison.md"
cp "$build/comparison.md" "$page"
cat "$page"
