#!/bin/sh
# Installs the Debian packages that are missing, as root or with sudo; does nothing, quickly, where all are there.
#
#   jobs/install.sh            what building, running and drawing need
#   jobs/install.sh --tests    that, and what tests/run.sh needs on top
#   jobs/install.sh --bench    what building needs, and tests/bench: the tests' framework, other solvers, a profiler
#
# The compiler for WebAssembly and the browser are left out, with a word, where apt does not offer them.
# shellcheck disable=SC2046,SC2086  # lists of packages are meant to be split into words
set -eu

packages="g++ make cmake ninja-build pkg-config git ca-certificates
  openmpi-bin libopenmpi-dev libhdf5-openmpi-dev zlib1g-dev libeigen3-dev libfftw3-dev nlohmann-json3-dev libcli11-dev
  libfmt-dev libboost-dev
  python3 python3-numpy python3-h5py python3-matplotlib python3-xarray python3-h5netcdf python3-pip python3-setuptools
  python3-wheel"
browser=""
case "${1-}" in
  "") ;;
  --tests)
    packages="$packages libgtest-dev libbenchmark-dev clang clang-format clang-tidy libclang-rt-dev llvm hdf5-tools
      netcdf-bin slurm-wlm iproute2 python3-selenium mypy python3-venv python3-yaml python3-nbconvert python3-ipykernel"
    browser="chromium chromium-driver"
    ;;
  --bench) packages="$packages libgtest-dev libbenchmark-dev libsundials-dev valgrind" ;;
  *)
    echo "install.sh: $1 is not an option; allowed: --tests, --bench" >&2
    exit 2
    ;;
esac

# not_in LIST PACKAGE...: the packages that a list, one a line, does not have.
not_in() {
  list=$1
  shift
  printf '%s\n' "$list" -- "$@" | awk '$0 == "--" { asked = 1; next } !asked { has[$0] } asked && NF && !($0 in has)'
}
# What compiles the solver of a report's page, with clang N.
wasm() { echo "clang-$1 lld-$1 libc++-$1-dev-wasm32 libc++abi-$1-dev-wasm32 libclang-rt-$1-dev-wasm32 wasi-libc"; }
# wasm_version LIST: the lowest N from 16 on of which a list has all. (The highest changes within a Debian's life.)
wasm_version() {
  for number in $(echo "$1" | sed -n 's/^libc++-\([0-9]*\)-dev-wasm32$/\1/p' | sort -n); do
    if [ "$number" -ge 16 ] && [ -z "$(not_in "$1" $(wasm "$number"))" ]; then echo "$number" && return; fi
  done
}

# A package counts as there only when fully installed, not when removed with its settings left.
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null | sed -n 's/ installed$//p')
missing=$(not_in "$installed" $packages)
[ -n "$missing$(not_in "$installed" $browser)" ] || [ -z "$(wasm_version "$installed")" ] || exit 0

as_root=""
[ "$(id -u)" -eq 0 ] || as_root=sudo
if [ -n "$missing" ]; then
  if ! command -v apt-get >/dev/null; then
    echo "install.sh: this is no Debian; please install what corresponds to:" $missing >&2
    exit 3
  fi
  if [ -n "$as_root" ] && ! command -v sudo >/dev/null; then
    echo "install.sh: neither root nor sudo; please have installed:" $missing >&2
    exit 3
  fi
  $as_root apt-get -qq -o DPkg::Lock::Timeout=300 update
fi

offered=""
if [ -z "$as_root" ] || command -v sudo >/dev/null; then
  offered=$(apt-cache dumpavail 2>/dev/null | sed -n 's/^Package: //p')
fi
if [ -z "$(wasm_version "$installed")" ]; then
  version=$(wasm_version "$offered")
  if [ -n "$version" ]; then
    missing="$missing $(not_in "$installed" $(wasm "$version"))"
  else
    echo "No clang for WebAssembly can be installed: reports will not compute points of their own."
  fi
fi
if [ -z "$(not_in "$offered" $browser)" ]; then
  missing="$missing $(not_in "$installed" $browser)"
elif [ -n "$(not_in "$installed" $browser)" ]; then
  echo "No Chromium can be installed: tests in a browser will be skipped."
fi
set -- $missing
[ $# -gt 0 ] || exit 0

echo "Installing: $*"
# Recommended packages would bring Fortran compilers and documentation that nothing here uses.
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o DPkg::Lock::Timeout=300 \
  install --no-install-recommends "$@" </dev/null >/dev/null
