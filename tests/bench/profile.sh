#!/bin/bash
# Instructions of a point of the default rotor, counted by callgrind: the same on a busy machine and on an idle one.
#
#   ./tests/bench/profile.sh [SPEED_RATIO [REVOLUTIONS [TOLERANCE [OBSERVABLE...]]]]     default: 0.62 60 1e-9 poincare
#
# Prints instructions per right-hand side, per touch-down and per revolution, then the costliest functions with
# what is inlined into them, the costliest source files, and both together.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ "${1-}" != --help ] || { sed -n '2,7s/^# \{0,1\}//p' tests/bench/profile.sh; exit 0; }
arguments=("${1:-0.62}" "${2:-60}" "${3:-1e-9}" "${@:4}")

./jobs/install.sh --bench
build=${RUBATLAS_BENCH_BUILD:-build-bench}
new_tree=()
# Line tables only name the source of an instruction; they change none.
[ -e "$build/CMakeCache.txt" ] || new_tree=(-G Ninja -DCMAKE_CXX_FLAGS=-g)
cmake -S . -B "$build" "${new_tree[@]}" -DRUBATLAS_BENCH=ON >/dev/null
cmake --build "$build" --target default_point --parallel "${RUBATLAS_BENCH_JOBS:-$(nproc)}" >/dev/null

out=$build/callgrind.out
valgrind --quiet --tool=callgrind --callgrind-out-file="$out" --toggle-collect='run_point(*' \
  "$build/tests/bench/default_point" "${arguments[@]}" | tee "$build/default_point.txt"
callgrind_annotate --threshold=100 --auto=no --show-percs=no "$out" >"$build/callgrind.txt"
/usr/bin/python3 tests/bench/profile_table.py "$build/callgrind.txt" "$build/default_point.txt" "${arguments[1]}"
