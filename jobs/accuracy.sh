#!/bin/bash
# What accuracy costs: runs both studies, draws them and prints the table. Minutes of a core with nothing else to do.
#
#   ./jobs/accuracy.sh              into atlases/accuracy
#   ./jobs/accuracy.sh --publish    and into jobs/studies/accuracy.md: its table, and the pictures in tools/pictures
set -euo pipefail
case "$#,${1-}" in
  0,) publish=no ;;
  1,--publish) publish=yes ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2 && exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=atlases/accuracy
mkdir -p "$folder"

# Exit code 10: some runs could not be integrated, which is what the study is there to tell.
study() { "${RUBATLAS:-build/rubatlas}" accuracy "$@" --overwrite || [ $? = 10 ]; }
study jobs/accuracy.json -o "$folder/trajectories.h5"
study jobs/accuracy_map.json -o "$folder/map.h5" --methods collocation,hybrid,fixed --steps 2e-2,1e-2 --repeats 1

draw() {
  tools/rubatlas-plot accuracy "$folder/trajectories.h5" --map "$folder/map.h5" \
    --reference tests/reference/orbits.json "$@"
}
if [ "$publish" = yes ]; then
  draw -o tools/pictures --dpi 75 --page jobs/studies/accuracy.md
else
  draw -o "$folder"
fi
