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
# Two minutes before the time is up: the program gives up the points it is at and ends with exit code 75.
#SBATCH --signal=B:USR1@120
set -euo pipefail

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
# Slurm runs a copy of this script from its spool: the place to work in is where sbatch was called.
cd "${SLURM_SUBMIT_DIR:-$PWD}"
scene=$1
atlas=${2:-atlases/$(basename "$scene" .json).h5}
program=${RUBATLAS:-build/rubatlas}
mkdir -p "$(dirname "$atlas")"

[ -e "$here/complete_atlas.sh" ] || here=jobs
[ -e "$here/complete_atlas.sh" ] || here=$(dirname "$program")/../jobs
. "$here/complete_atlas.sh"
again="sbatch -n ${SLURM_NTASKS:-1} jobs/slurm.sh $scene $atlas"
code=0
complete_atlas "$scene" "$atlas" plain mpirun -n "${SLURM_NTASKS:-1}" || code=$?

case $code in
  0) echo "done: $atlas" ;;
  10) echo "done, but some points could not be integrated (see /status): $atlas" ;;
  75)
    echo "stopped and resumable; to go on: $again"
    # With RUBATLAS_RESUBMIT=1 it does so itself.
    if [ "${RUBATLAS_RESUBMIT:-0}" = 1 ]; then sbatch -n "${SLURM_NTASKS:-1}" jobs/slurm.sh "$scene" "$atlas"; fi
    ;;
  2 | 3) echo "slurm.sh: the run ended with exit code $code" >&2 ;;
  *) echo "slurm.sh: the run ended with exit code $code before it was done; to go on: $again" >&2 ;;
esac
exit "$code"
