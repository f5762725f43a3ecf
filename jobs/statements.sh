#!/bin/bash
# The paper's statements about its Fig. 4 under both contact laws, over the ring's stiffness, the unbalance, its phase
# and the direction of the sweep: runs the scenes fig4_*.json, judges them, draws the two maps and prints them in short.
#
#   jobs/statements.sh             into atlases/ and pictures/; about a quarter of an hour on two cores
#   jobs/statements.sh --publish   and renews the pictures of tools/pictures
#
# What an atlas holds is not computed again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
publish=false
case "${1-}" in
  "") ;;
  --publish) publish=true ;;
  *)
    sed -n '2,8s/^# \{0,1\}//p' jobs/statements.sh >&2
    exit 2
    ;;
esac
. jobs/mpi_environment.sh
. jobs/complete_atlas.sh
program=build/rubatlas

mkdir -p atlases pictures
for name in fig4_elastica fig4_elastic_ring fig4_stiffness fig4_phase_elastica fig4_phase_elastic_ring; do
  whole_atlas "jobs/$name.json" "atlases/$name.h5" mpirun --oversubscribe --bind-to none -n "$(nproc)"
  build/rubatlas analyse "atlases/$name.h5" -o "atlases/${name}_maps.h5" --table "atlases/$name.md" --overwrite \
    >/dev/null
done
tools/rubatlas-plot statement_map atlases/fig4_{elastica,elastic_ring,stiffness}_maps.h5 \
  -o pictures/statement_map.png --counts --dpi 75
tools/rubatlas-plot statement_map atlases/fig4_phase_{elastica,elastic_ring}_maps.h5 \
  -o pictures/statement_map_phase.png --counts --dpi 75 --statements P1,P2,P3,P4,P8 \
  --title "What the paper says of Fig. 4, by phase of the unbalance and direction"
if $publish; then cp pictures/statement_map.png pictures/statement_map_phase.png tools/pictures/; fi
