#!/bin/bash
# Makes the small real files that the tests of tools and documentation read: make_tiny_atlas.sh PROGRAM FOLDER
set -euo pipefail
program=$1 folder=$2
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
scene=$here/tiny.json
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
# Some points leave the model, which the readers of an atlas have to cope with.
"$program" run "$scene" -o atlas.h5 --overwrite --progress off
"$program" analyse atlas.h5 -o maps.h5 --table table1.md >/dev/null
"$program" orbit "$scene" --at speed_ratio=0.3,damping_ratio=0.1 -o orbit.h5
# The same rotor with an effect.
"$program" run "$here/gravity.json" -o gravity.h5 --overwrite --progress off
# An atlas with an axis that its scene names by a JSON pointer.
"$program" run "$here/rings.json" -o rings.h5 --overwrite --progress off
"$program" analyse rings.h5 -o rings_maps.h5 >/dev/null
"$program" orbit "$here/rings.json" --at speed_ratio=0.4,damping_ratio=0.1,ring_radius=0.1095 -o rings_orbit.h5
# An atlas whose initial state is an axis.
"$program" run "$here/basins.json" -o basins.h5 --overwrite --progress off
"$program" analyse basins.h5 -o basins_maps.h5 >/dev/null
"$program" accuracy "$here/tiny_accuracy.json" -o accuracy.h5 --methods hybrid --tolerances 1e-5,1e-7,1e-9 \
  --repeats 1 --progress off
