#!/bin/sh
# Installs the Debian packages that are missing, as root or with sudo; does nothing, quickly, where all are there.
#
#   jobs/install.sh            what building, running and drawing need
#   jobs/install.sh --tests    that, and what tests/run.sh needs on top
#   jobs/install.sh --bench    what building needs, and tests/bench: the tests' framework, other solvers, a profiler
set -eu

packages="g++ make cmake ninja-build pkg-config git ca-certificates
  openmpi-bin libopenmpi-dev libhdf5-openmpi-dev zlib1g-dev libeigen3-dev libfftw3-dev nlohmann-json3-dev libcli11-dev
  libfmt-dev libboost-dev
  clang-16 lld-16 wasi-libc libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 libclang-rt-16-dev-wasm32
  python3 python3-numpy python3-h5py python3-matplotlib python3-xarray python3-h5netcdf python3-pip python3-setuptools python3-wheel"
case "${1-}" in
  "") ;;
  --tests) packages="$packages libgtest-dev libbenchmark-dev clang clang-format clang-tidy libclang-rt-dev
    llvm hdf5-tools netcdf-bin slurm-wlm iproute2 chromium chromium-driver python3-selenium mypy python3-venv python3-nbconvert python3-ipykernel" ;;
  --bench) packages="$packages libgtest-dev libbenchmark-dev libsundials-dev valgrind" ;;
  *)
    echo "install.sh: $1 is not an option; allowed: --tests, --bench" >&2
    exit 2
    ;;
esac

# libgtest-dev and the others count as there only when fully installed, not when removed with their settings left.
missing=""
for package in $packages; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "install.sh: this is no Debian; please install what corresponds to:$missing" >&2
  exit 3
fi
as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install.sh: neither root nor sudo; please have installed:$missing" >&2
    exit 3
  fi
  as_root=sudo
fi

echo "Installing:$missing"
export DEBIAN_FRONTEND=noninteractive
# Recommended packages would bring Fortran compilers and documentation that nothing here uses.
$as_root apt-get -qq -o DPkg::Lock::Timeout=300 update
# shellcheck disable=SC2086  # the list is meant to be split into words
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o DPkg::Lock::Timeout=300 \
  install --no-install-recommends $missing </dev/null >/dev/null
