#!/bin/bash
# Draws everything that an atlas has to show; each picture is one command of this folder, here on its defaults:
#
#   tools/draw.sh ATLAS.h5 MAPS.h5 FOLDER
#
# With several swept parameters displacement.png and sensitivity.png are along the first of them, and
# displacement_AXIS.png, sensitivity_AXIS.png along each of the others. Of an atlas whose initial state is an axis
# there is one picture, basins.png.
set -euo pipefail
if [ $# -ne 3 ]; then
  sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
atlas=$1 maps=$2 folder=$3
tools=$(dirname "${BASH_SOURCE[0]}")

# What there is to draw: "has NAME" for a dataset of the atlas or of its maps, "along AXIS" for a swept parameter.
found=$(/usr/bin/python3 - "$tools" "$atlas" "$maps" <<'CONTENTS'
import sys
sys.path.insert(0, sys.argv[1])
sys.argv[0] = "draw.sh"
from rubatlas import command_line
from rubatlas.atlas_file import AtlasFile
from rubatlas.same_scene import require_same

def contents():
    with AtlasFile(sys.argv[2]) as atlas, AtlasFile(sys.argv[3]) as maps:
        require_same(atlas.path, atlas.scene, maps.path, maps.scene)
        print(*(f"has {name}" for file in (atlas, maps) for name in file.file), sep="\n")
        print(*(f"along {axis}" for axis in atlas.swept_axes()), sep="\n")
        if atlas.scene["contact"]["law"] == "elastica":  # rigid blades have no curve of force over displacement
            print("has blade_curve")

command_line.end_on_mistakes(contents)
CONTENTS
)
has() { grep -qFx "has $1" <<<"$found"; }
mkdir -p "$folder"

# From many initial states: a line has one of them, and says little.
if has basins; then
  "$tools/rubatlas-plot" basins "$atlas" --maps "$maps" -o "$folder/basins.png"
  exit
fi
if has poincare; then "$tools/rubatlas-plot" bifurcation "$atlas" -o "$folder/bifurcation.png"; fi
if has spectrum; then "$tools/rubatlas-plot" waterfall "$atlas" -o "$folder/waterfall.png"; fi
if has max_displacement; then
  mapfile -t axes < <(sed -n 's/^along //p' <<<"$found")
  for axis in "${axes[@]:-}"; do  # at least once: without a swept parameter there is one line to draw
    along=() name=
    if [ -n "$axis" ]; then along=(--along "$axis"); fi
    if [ "$axis" != "${axes[0]-}" ]; then name=_$axis; fi
    "$tools/rubatlas-plot" displacement "$atlas" "${along[@]}" -o "$folder/displacement$name.png"
    "$tools/rubatlas-plot" map "$atlas" --maps "$maps" "${along[@]}" -o "$folder/sensitivity$name.png"
    if has class_blade_passing; then
      "$tools/rubatlas-plot" map "$atlas" --maps "$maps" --passing "${along[@]}" \
        -o "$folder/sensitivity_blade_passing$name.png"
    fi
  done
fi
if has blade_curve; then "$tools/rubatlas-plot" blade "$atlas" -o "$folder/blade.png"; fi
