#!/bin/bash
# Runs any scene on a cluster:
#
#   sbatch -n 64 jobs/slurm.sh jobs/damping.json [ATLAS.h5]
#
# The atlas goes to atlases/<scene>.h5 unless named. Submit the same line again to complete an interrupted run: points that
# are there are never repeated. The program must have been built (README.md, "Building").
#SBATCH --job-name=rubatlas
#SBATCH --time=08:00:00
#SBATCH --cpus-per-task=1
#SBATCH --hint=nomultithread
#SBATCH --open-mode=append
# Two minutes before the time is up: the program finishes what it is writing and ends with exit code 75.
#SBATCH --signal=B:USR1@120
set -euo pipefail

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
# Slurm runs a copy of this script from its spool: the place to work in is where sbatch was called.
cd "${SLURM_SUBMIT_DIR:-$PWD}"
scene=$1
atlas=${2:-atlases/$(basename "$scene" .json).h5}
program=${RUBATLAS:-build/rubatlas}
mkdir -p "$(dirname "$atlas")"

# In the background, so that this shell can hear the signal and hand it on; mpirun forwards USR1 to the ranks.
mpirun -n "${SLURM_NTASKS:-1}" "$program" run "$scene" -o "$atlas" --resume --progress plain &
run=$!
# `wait` returns when the signal arrives, while the run is still ending: then wait again.
heard=0
trap 'heard=1; kill -USR1 "$run" || true' USR1
while :; do
  heard=0 code=0
  wait "$run" || code=$?
  [ "$heard" = 1 ] || break
done

case $code in
  0) echo "done: $atlas" ;;
  1) echo "done, some points without a motion (see /status): $atlas" && code=0 ;;
  75)
    echo "stopped at the time limit and resumable; to go on: sbatch -n ${SLURM_NTASKS:-1} jobs/slurm.sh $scene $atlas"
    # With RUBATLAS_RESUBMIT=1 it does so itself.
    if [ "${RUBATLAS_RESUBMIT:-0}" = 1 ]; then sbatch -n "${SLURM_NTASKS:-1}" jobs/slurm.sh "$scene" "$atlas"; fi
    ;;
  *) echo "slurm.sh: the run ended with exit code $code" >&2 ;;
esac
exit "$code"
