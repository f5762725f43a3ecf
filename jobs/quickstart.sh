#!/bin/bash
# From a fresh clone to an atlas, its Table 1, its pictures and a report to explore it:
#
#   ./jobs/quickstart.sh                  runs jobs/quick.json
#   ./jobs/quickstart.sh jobs/rig.json    runs another scene
#
# A second call completes what an interrupted one left out, and is quick where nothing is missing. Ctrl-C stops the run
# in good order (exit code 130), a second one at once.
set -euo pipefail

usage() { sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }
case "$#,${1-}" in
  1,-h | 1,--help) usage && exit 0 ;;
  0,* | 1,[!-]*) ;;
  *) usage >&2 && exit 2 ;;
esac
scene=$(realpath "${1-$(dirname "${BASH_SOURCE[0]}")/quick.json}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

name=$(basename "$scene" .json)
atlas=atlases/$name.h5
maps=atlases/${name}_maps.h5
table=atlases/${name}_table1.md
pictures=atlases/$name
report=atlases/$name.html
say() { printf '\n== %s\n' "$*"; }

say "1/6 Packages"
./jobs/install.sh

say "2/6 Build, in build/"
# A build tree that is already there (made by tests/run.sh, say) keeps its options: nothing is compiled twice.
[ -e build/CMakeCache.txt ] || cmake -S . -B build -G Ninja -DRUBATLAS_TESTS=OFF
cmake --build build --target rubatlas

say "3/6 Run $name on $(nproc) cores"
mkdir -p "$pictures"
# Under mpirun a rank's stderr is never a terminal, so the bar is asked for where ours is one.
progress=plain
if [ -t 2 ]; then progress=bar; fi
. jobs/mpi_environment.sh
. jobs/complete_atlas.sh
program=build/rubatlas
again="./jobs/quickstart.sh $(printf %q "$scene")"
run_code=0
complete_atlas "$scene" "$atlas" "$progress" mpirun -n "$(nproc)" --oversubscribe --bind-to none || run_code=$?
case $run_code in
  0) ;;
  10) echo "Some points could not be integrated; the atlas says which, in /status." ;;
  75 | 129 | 130 | 143) echo "Stopped; to go on from here: $again" && exit "$run_code" ;;
  *)
    echo "quickstart.sh: the run ended with exit code $run_code; to go on: $again" >&2
    exit "$run_code"
    ;;
esac

say "4/6 Analyse"
# Its text is for the terminal, after the pictures and at the very end; the same as Markdown goes to a file.
summary=$(build/rubatlas analyse "$atlas" -o "$maps" --table "$table" --overwrite)

say "5/6 Draw"
tools/rubatlas-plot all "$atlas" --maps "$maps" -o "$pictures" >/dev/null

# The table, and the paths of all that is there.
show() {
  printf '%s\n\n' "$summary"
  printf '%s\n' "Atlas:    $atlas" "Maps:     $maps" "Table 1:  $table" "Pictures:" "$pictures"/*.png "$@"
}
show

say "6/6 Make a page to explore the atlas, with a solver of its own ($((SECONDS / 60)) min $((SECONDS % 60)) s so far)"
cmake --build build --target rubatlas_wasm
tools/rubatlas-report "$atlas" --maps "$maps" -o "$report"

say "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s"
show "Report:   $report (opens in a browser)"
exit "$run_code"
