#!/bin/bash
# Makes the small real files that the tests of tools and documentation read: make_tiny_atlas.sh PROGRAM FOLDER
set -euo pipefail
program=$1 folder=$2
scene=$(realpath "$(dirname "${BASH_SOURCE[0]}")/tiny.json")
mkdir -p "$folder"
cd "$folder"
"$program" run "$scene" -o atlas.h5 --overwrite --progress off
"$program" analyse atlas.h5 -o maps.h5 --table table1.md >/dev/null
"$program" orbit "$scene" --at speed_ratio=0.3 -o orbit.h5
