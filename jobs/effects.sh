#!/bin/bash
# What each effect does to the default rotor: runs its scene with and without it, draws both side by side, and prints
# regions and triggers of all in one table.
#
#   ./jobs/effects.sh                     every jobs/effect_<name>.json
#   ./jobs/effects.sh gravity wear ...    these
#   ./jobs/effects.sh --publish [...]     also renews tools/pictures/effect_<name>.png
#
# Atlases go to atlases/, pictures beside them, the table to atlases/effects.md. The scene without the effect is the
# same file without its section.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ "${1-}" != --help ] || { sed -n '2,11s/^# \{0,1\}//p' jobs/effects.sh; exit 0; }
publish=no
[ "${1-}" != --publish ] || { publish=yes; shift; }
program=${RUBATLAS:-build/rubatlas}
[ -x "$program" ] || { echo "effects.sh: no program at $program; ./jobs/quickstart.sh builds it" >&2; exit 2; }

names=("$@")
if [ $# -eq 0 ]; then
  for scene in jobs/effect_*.json; do
    name=${scene#jobs/effect_}
    names+=("${name%.json}")
  done
fi
mkdir -p atlases
. jobs/complete_atlas.sh
# regions ATLAS NAME: the row of regions and triggers that `analyse` finds, under a name; HEAD for what stands above it.
regions() {
  "$program" analyse "$1.h5" -o "$1_maps.h5" --table "$1.md" --overwrite >/dev/null
  awk -v name="$2" '/^## Regions/ { found = 1 }
    found && /^\|/ && (++lines < 3) == (name == "HEAD") { if (lines == 3) sub(/^\|[^|]*/, "| " name " "); print }
    lines == 3 { exit }' "$1.md"
}
table=atlases/effects.md
: >"$table"
for name in "${names[@]}"; do
  scene=jobs/effect_$name.json
  [ -e "$scene" ] || { echo "effects.sh: $scene is not there" >&2; exit 2; }
  with=atlases/effect_$name without=atlases/effect_${name}_without
  /usr/bin/python3 -c '
import json, sys
effect, scene, plain = sys.argv[1:]
content = json.load(open(scene, encoding="utf-8"))
del content[effect]
json.dump(content, open(plain, "w", encoding="utf-8"), indent=2)' \
    "$(jobs/effect_of.py "$scene")" "$scene" "$without.json"
  whole_atlas "$scene" "$with.h5"
  whole_atlas "$without.json" "$without.h5"
  tools/rubatlas-plot effect "$with.h5" --without "$without.h5" --dpi 60 -o "$with.png"
  [ "$publish" = no ] || cp "$with.png" tools/pictures/
  [ -s "$table" ] || regions "$without" HEAD >>"$table"
  # Most scenes are the default rotor without their effect: that row once.
  row=$(regions "$without" "none (${name//_/ })")
  cut -d'|' -f3- "$table" | grep -Fqx "$(cut -d'|' -f3- <<<"$row")" || echo "$row" >>"$table"
  regions "$with" "${name//_/ }" >>"$table"
done
cat "$table"
