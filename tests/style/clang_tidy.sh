#!/bin/bash
# What clang-tidy has to say of the program's sources: nothing.
#
#   clang_tidy.sh CLANG_TIDY BUILD
#
# Each folder's sources are read as one, in a tree of their own in BUILD, since most of the time goes into the headers
# of the libraries: minutes instead of a quarter of an hour.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$2

rm -rf "$tree"  # it may hold folders that the sources no longer have
cmake -S "$source" -B "$tree" -G Ninja -DRUBATLAS_TESTS=OFF -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 >/dev/null
cmake --build "$tree" --target rubatlas_build_info >/dev/null
# Such a source includes other sources, which is the one check that is switched off. src/assembly takes longest and
# comes first.
{
  find "$tree/src/assembly" -name 'unity_*.cxx'
  find "$tree" -name 'unity_*.cxx' -not -path '*/src/assembly/*'
} | xargs -P "$(nproc)" -n 1 \
  "$1" -quiet -p "$tree" -config="$(<"$source/.clang-tidy")" -checks=-bugprone-suspicious-include
