#!/bin/bash
# Computes a scene on a cluster in parts, each of which is a job of its own, and makes one atlas of them:
#
#   jobs/slurm_array.sh PARTS RANKS SCENE.json [ATLAS.h5]
#
# submits an array of PARTS jobs of RANKS ranks each, and a job that merges the parts when all have ended. A failing
# node then costs the time of one part only. The parts go beside the atlas (<atlas>.part2of8.h5). Call it again to
# complete interrupted parts. Options for sbatch come from its environment (SBATCH_PARTITION, SBATCH_TIMELIMIT, ...).
set -euo pipefail

if [ $# -lt 3 ] || [ $# -gt 4 ]; then
  sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
parts=$1 ranks=$2 scene=$3
atlas=${4:-atlases/$(basename "$scene" .json).h5}
program=${RUBATLAS:-build/rubatlas}
here=$(dirname "${BASH_SOURCE[0]}")

array=$(sbatch --parsable --array="1-$parts" -n "$ranks" "$here/slurm.sh" "$scene" "$atlas" "$parts")
# The shell of the job finds the parts that are there; whatever is missing stays pending in the atlas.
merging="$(printf '%q ' "$program" merge)$(printf %q "${atlas%.h5}").part*of$parts.h5"
merging+=" -o $(printf %q "$atlas") --overwrite"
merge=$(sbatch --parsable --job-name=rubatlas-merge --dependency="afterany:$array" -n 1 --wrap "$merging")
echo "parts: job $array; then job $merge: $merging"
