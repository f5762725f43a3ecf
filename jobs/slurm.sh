#!/bin/bash
# Runs any scene on a cluster:
#
#   sbatch -n 64 jobs/slurm.sh jobs/damping.json [ATLAS.h5]
#
# The atlas goes to atlases/<scene>.h5 unless named. Submit the same line again to complete an interrupted run: points
# that are there are never repeated. With RUBATLAS_REQUEUE=1 in the environment of sbatch the job does so itself at its
# time limit. With a number of parts behind the atlas each job of an array computes the part of its task number, into an
# atlas of its own (jobs/slurm_array.sh submits it). jobs/systems.md says how to build the program on a cluster.
#SBATCH --job-name=rubatlas
#SBATCH --time=08:00:00
#SBATCH --cpus-per-task=1
#SBATCH --hint=nomultithread
#SBATCH --open-mode=append
# A job whose node has failed begins again, and goes on with the points that are there.
#SBATCH --requeue
# Two minutes before the time is up: the program gives up the points it is at and ends with exit code 75.
#SBATCH --signal=B:USR1@120
set -euo pipefail

if [ $# -lt 1 ] || [ $# -gt 3 ]; then
  sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
# Slurm runs a copy of this script from its spool: the place to work in is where sbatch was called.
cd "${SLURM_SUBMIT_DIR:-$PWD}"
scene=$1
atlas=${2:-atlases/$(basename "$scene" .json).h5}
program=${RUBATLAS:-build/rubatlas}
ranks=${SLURM_NTASKS:-1}
again="sbatch -n $ranks jobs/slurm.sh $(printf '%q ' "$@")"
part=""
if [ $# -eq 3 ]; then
  if [ -z "${SLURM_ARRAY_TASK_ID-}" ]; then
    echo "slurm.sh: the job of a part is a task of an array: sbatch --array=1-$3 ..." >&2
    exit 2
  fi
  part=$SLURM_ARRAY_TASK_ID/$3
  atlas=${atlas%.h5}.part${part/\//of}.h5
  again="sbatch --array=$SLURM_ARRAY_TASK_ID -n $ranks jobs/slurm.sh $(printf '%q ' "$@")"
fi
mkdir -p "$(dirname "$atlas")"

[ -e "$here/complete_atlas.sh" ] || here=jobs
[ -e "$here/complete_atlas.sh" ] || here=$(dirname "$program")/../jobs
. "$here/complete_atlas.sh"
code=0
complete_atlas "$scene" "$atlas" plain mpirun -n "$ranks" || code=$?

case $code in
  0) echo "done: $atlas" ;;
  10) echo "done, but some points could not be integrated (see /status): $atlas" ;;
  75)
    echo "stopped and resumable; to go on: $again"
    # Slurm ends this script while it puts the job back into the queue.
    if [ "${RUBATLAS_REQUEUE:-0}" = 1 ]; then scontrol requeue "$SLURM_JOB_ID"; fi
    ;;
  2 | 3) echo "slurm.sh: the run ended with exit code $code" >&2 ;;
  *) echo "slurm.sh: the run ended with exit code $code before it was done; to go on: $again" >&2 ;;
esac
exit "$code"
