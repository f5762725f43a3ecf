#!/bin/bash
# What an effect costs where it is absent: the default rotor in this program, and in builds in which the effect
# does not exist.
#
#   ./tests/bench/absence.sh [EFFECT... | all]     default: each effect of jobs/effect_*.json, then all at once
#
# Each build runs the same scene under callgrind: 24 speeds of jobs/default.json, 30 revolutions each. Prints
# instructions of the solver per right-hand side and per revolution, and whether both atlases have the same bytes.
# A build takes minutes, and there is one for each effect, in build-absence/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ "${1-}" != --help ] || { sed -n '2,9s/^# \{0,1\}//p' tests/bench/absence.sh; exit 0; }
effects=("$@")
if [ $# -eq 0 ]; then
  # Some effects have two scenes.
  mapfile -t effects < <(for scene in jobs/effect_*.json; do jobs/effect_of.py "$scene"; done | uniq)
  effects+=(all)
fi

./jobs/install.sh --bench
build=${RUBATLAS_ABSENCE_BUILD:-build-absence}
mkdir -p "$build"
scene=$build/scene.json
/usr/bin/python3 - "$scene" <<'SCENE'
import json, sys
scene = json.load(open("jobs/default.json", encoding="utf-8"))
scene["grid"]["speed_ratio"]["count"] = 24
scene["protocol"] = {"transient_revolutions": 20, "sampled_revolutions": 10}
json.dump(scene, open(sys.argv[1], "w", encoding="utf-8"))
SCENE

# run_without EFFECTS NAME: builds, runs, leaves NAME.h5 and NAME.callgrind.
run_without() {
  local tree=$build/$2 generator=()
  [ -e "$tree/CMakeCache.txt" ] || generator=(-G Ninja)
  cmake -S . -B "$tree" "${generator[@]}" -DRUBATLAS_TESTS=OFF -DCMAKE_UNITY_BUILD=ON -DRUBATLAS_WITHOUT_EFFECTS="$1" \
    >"$tree.log"
  cmake --build "$tree" --target rubatlas --parallel "${RUBATLAS_BENCH_JOBS:-$(nproc)}" >>"$tree.log"
  # The same name for both atlases, whatever is in the file. Counted from the start of a point on.
  rm -rf "$tree.out" && mkdir "$tree.out"
  valgrind --quiet --tool=callgrind --callgrind-out-file="$tree.callgrind" \
    --toggle-collect='rubatlas::point::PointSolver::run(*' \
    "$tree/rubatlas" run "$scene" -o "$tree.out/atlas.h5" --progress off >>"$tree.log" 2>&1
}

echo "building and running the program with every effect" >&2
run_without "" whole
for effect in "${effects[@]}"; do
  echo "building and running it without: $effect" >&2
  run_without "$effect" "without_$effect"
done
/usr/bin/python3 tests/bench/absence_table.py "$build" "${effects[@]}"
