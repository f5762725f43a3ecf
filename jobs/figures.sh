#!/bin/bash
# The paper's figures that a computation can show: 2, 3, 4a to 4c, 9, 10 a1 and 10 b1, each drawn by one command from an
# atlas or orbits that are computed first.
#
#   jobs/figures.sh             into atlases/figures; about five minutes on two cores
#   jobs/figures.sh --publish   and renews the pictures of tools/pictures
#
# What an atlas holds is not computed again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
publish=false
case "$#,${1-}" in
  0,) ;;
  1,--publish) publish=true ;;
  *) sed -n '2,8s/^# \{0,1\}//p' jobs/figures.sh >&2 && exit 2 ;;
esac
. jobs/mpi_environment.sh
. jobs/complete_atlas.sh
program=build/rubatlas

folder=atlases/figures
mkdir -p "$folder"
for name in fig3 damping_elastic_ring friction unbalance rig; do
  whole_atlas "jobs/$name.json" "atlases/$name.h5" mpirun --oversubscribe --bind-to none -n "$(nproc)"
  "$program" analyse "atlases/$name.h5" -o "atlases/${name}_maps.h5" --overwrite >/dev/null
done
# Fig. 9: with the largest friction that the paper gives its rig, each from rest.
orbits=()
for speed in 0.304 0.4 0.605 0.74; do
  orbits+=("$folder/orbit_$speed.h5")
  "$program" orbit jobs/rig.json --at "speed_ratio=$speed,friction=0.2" -o "${orbits[-1]}" --overwrite
done

draw() { tools/rubatlas-plot "$@" --dpi 75; }
draw blade atlases/rig.h5 -o "$folder/fig2.png"
draw bifurcation atlases/fig3.h5 --zoom 0.22:0.335 --zoom 0.6815:0.6861 -o "$folder/fig3.png"
draw stack atlases/damping_elastic_ring.h5 -o "$folder/fig4a.png"
draw stack atlases/friction.h5 -o "$folder/fig4b.png"
draw stack atlases/unbalance.h5 --values 0,1e-6,1e-5,5e-5,1e-4 -o "$folder/fig4c.png"
draw orbit "${orbits[@]}" -o "$folder/fig9.png"
draw bifurcation atlases/rig.h5 --friction 0.2 -o "$folder/fig10a1.png"
draw waterfall atlases/rig.h5 --friction 0.2 -o "$folder/fig10b1.png"
if $publish; then cp "$folder"/fig*.png tools/pictures/; fi
