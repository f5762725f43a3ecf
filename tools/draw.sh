#!/bin/bash
# Draws everything that an atlas has to show; each picture is one command of this folder, here on its defaults:
#
#   tools/draw.sh ATLAS.h5 MAPS.h5 FOLDER
set -euo pipefail
if [ $# -ne 3 ]; then
  sed -n '2,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
atlas=$1 maps=$2 folder=$3
tools=$(dirname "${BASH_SOURCE[0]}")
mkdir -p "$folder"

has() { /usr/bin/python3 -c 'import h5py, sys; sys.exit(sys.argv[2] not in h5py.File(sys.argv[1], "r"))' "$@"; }
law() {
  /usr/bin/python3 -c 'import h5py, json, sys
print(json.loads(h5py.File(sys.argv[1], "r")["scene_resolved"][()])["contact"]["law"])' "$1"
}

"$tools/bifurcation.py" "$atlas" -o "$folder/bifurcation.png"
if has "$atlas" spectrum; then "$tools/waterfall.py" "$atlas" -o "$folder/waterfall.png"; fi
"$tools/displacement.py" "$atlas" -o "$folder/displacement.png"
"$tools/sensitivity.py" "$atlas" --maps "$maps" -o "$folder/sensitivity.png"
if has "$maps" class_blade_passing; then
  "$tools/sensitivity.py" "$atlas" --maps "$maps" --passing -o "$folder/sensitivity_blade_passing.png"
fi
# Rigid blades have no force-displacement curve of their own.
if [ "$(law "$atlas")" = elastica ]; then "$tools/blade.py" "$atlas" -o "$folder/blade.png"; fi
