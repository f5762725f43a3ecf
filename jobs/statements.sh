#!/bin/bash
# What the atlases of the paper's rotors say of its statements: runs the scenes below, judges them, prints the verdicts,
# agreeing or not, and draws by contact law, stiffness, phase and direction what it says of its Fig. 4.
#
#   jobs/statements.sh [ATLAS.h5 ...]             into atlases/; about an hour on two cores
#   jobs/statements.sh --publish [ATLAS.h5 ...]   and renews the pictures of tools/pictures
#
# What an atlas holds is not computed again. Further atlases, such as those of rig_unbalance.json, are judged too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
publish=false
case "${1-}" in
  --publish)
    publish=true
    shift
    ;;
  -*)
    sed -n '2,8s/^# \{0,1\}//p' jobs/statements.sh >&2
    exit 2
    ;;
esac
. jobs/mpi_environment.sh
. jobs/complete_atlas.sh
program=build/rubatlas

analysed() { $program analyse "$1" -o "${1%.h5}_maps.h5" --overwrite >/dev/null; }

fig4=(fig4_elastica fig4_elastic_ring fig4_stiffness)
phases=(fig4_phase_elastica fig4_phase_elastic_ring)
others=(quick friction blades_5 blades_10 blades_50 rig rig_thickness rig_clearance)
mkdir -p atlases/figures
for name in "${fig4[@]}" "${phases[@]}" "${others[@]}"; do
  whole_atlas "jobs/$name.json" "atlases/$name.h5" mpirun --oversubscribe --bind-to none -n "$(nproc)"
  analysed "atlases/$name.h5"
done
for atlas in "$@"; do analysed "$atlas"; done
paths() { printf 'atlases/%s.h5\n' "$@"; }
mapfile -t of_others < <(paths "${others[@]}")
mapfile -t of_fig4 < <(paths "${fig4[@]}")
mapfile -t of_phases < <(paths "${phases[@]}")
analysis/paper/judge "${of_others[@]}" "${of_fig4[@]}" "$@" --short --json atlases/statements.json
analysis/paper/judge "${of_fig4[@]}" --json atlases/statements_fig4.json >/dev/null
analysis/paper/judge "${of_phases[@]}" --json atlases/statements_phase.json >/dev/null
analysis/paper/statement_map atlases/statements_fig4.json -o atlases/figures/statement_map.png --counts --dpi 75
analysis/paper/statement_map atlases/statements_phase.json -o atlases/figures/statement_map_phase.png \
  --counts --dpi 75 --statements P1a,P1b,P2a,P2b,P3,P4,P8a,P8b,P8c,P8d \
  --title "What the paper says of Fig. 4, by phase of the unbalance and direction"
if $publish; then cp atlases/figures/statement_map*.png tools/pictures/; fi
