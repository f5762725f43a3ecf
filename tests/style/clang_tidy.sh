#!/bin/bash
# What clang-tidy has to say of the program's sources: nothing.
#
#   clang_tidy.sh CLANG_TIDY BUILD changed    folders in which something has changed since the last tag, since the
#                                             branch left its upstream, or in the last commit, or is not committed
#   clang_tidy.sh CLANG_TIDY BUILD all        all folders: minutes
#
# Each folder's sources are read as one, in a tree of their own in BUILD, since most of the time goes into the headers
# of the libraries.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tree=$2

changed_folders() {
  local base
  base=$(git describe --tags --abbrev=0 2>/dev/null || git merge-base HEAD '@{upstream}' 2>/dev/null || true)
  if [ -z "$base" ] || [ "$(git rev-parse "$base^{commit}")" = "$(git rev-parse HEAD)" ]; then base=HEAD~1; fi
  git diff --name-only "$base" -- 'src/*.?pp' 'analysis/*.?pp' 'mpi/*.?pp' |
    grep -oE '^(src/[^/]+|analysis|mpi)/' | sort -u
}
if [ "$3" = all ] || ! git rev-parse HEAD~1 >/dev/null 2>&1; then
  folders=$(ls -d src/*/ analysis/ mpi/)
else
  folders=$(changed_folders || true)
fi
[ -n "$folders" ] || exit 0

rm -rf "$tree"  # it may hold folders that the sources no longer have
# Warnings of the compiler are no errors here: clang does not know all of GCC's options.
CXXFLAGS='' cmake -S . -B "$tree" -G Ninja -DRUBATLAS_TESTS=OFF >/dev/null
cmake --build "$tree" --target rubatlas_build_info >/dev/null
# Such a source includes other sources, which is the one check that is switched off. src/assembly takes longest and
# comes first.
for folder in $folders; do find "$tree/$folder" -name 'unity_*.cxx' 2>/dev/null || true; done |
  awk '/assembly/ { print; next } { rest[NR] = $0 } END { for (i in rest) print rest[i] }' |
  xargs -r -P "$(nproc)" -n 1 \
    "$1" -quiet -p "$tree" -config="$(<.clang-tidy)" -checks=-bugprone-suspicious-include
