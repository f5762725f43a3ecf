#!/bin/bash
# Both commands of a fresh clone, jobs/quickstart.sh and tests/run.sh, in minimal roots of Debian 12 and 13, in which
# there is nothing else: as a user with sudo in the first, as root in the second. HEAD is what is cloned.
#
#   tests/systems.sh                       both systems, both commands; hours
#   tests/systems.sh bookworm              one of bookworm, trixie
#   tests/systems.sh --quickstart          one of the commands: --quickstart, --tests
#   tests/systems.sh trixie --tests -- --both       what follows -- goes to tests/run.sh
#
# Needs root and debootstrap, and takes mirror and proxy from this machine's apt. The roots lie in $RUBATLAS_ROOTS,
# where the next call finds them with their packages, or else in a folder that is removed. The exit code is 0 only where
# all is well.
set -euo pipefail
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")

suites=()
commands=()
for_run=()
while [ $# -gt 0 ]; do
  case $1 in
    bookworm | trixie) suites+=("$1") ;;
    --quickstart | --tests) commands+=("${1#--}") ;;
    --)
      shift
      for_run=("$@")
      break
      ;;
    *)
      sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
      [ "$1" = --help ] && exit 0 || exit 2
      ;;
  esac
  shift
done
[ ${#suites[@]} -gt 0 ] || suites=(bookworm trixie)
[ ${#commands[@]} -gt 0 ] || commands=(quickstart tests)

if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "systems.sh: needs root and debootstrap (Debian's package)" >&2
  exit 3
fi
roots=${RUBATLAS_ROOTS-}
if [ -z "$roots" ]; then
  roots=$(mktemp -d)
  trap 'rm -rf --one-file-system "$roots"' EXIT
fi
mkdir -p "$roots"
roots=$(realpath "$roots")

# make_root SUITE: a minimal root, with the ways to packages that this machine has, and a user with sudo.
make_root() {
  local root=$roots/$1 mirror http_proxy=${http_proxy-}
  # shellcheck disable=SC2016
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' |
    head -n 1)
  [ -n "$http_proxy" ] || eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
  export http_proxy
  if [ ! -e "$root/made" ]; then
    rm -rf --one-file-system "$root"
    # shellcheck disable=SC2086  # no mirror, no argument
    debootstrap --variant=minbase --include=sudo,git,ca-certificates "$1" "$root" $mirror >"$root.debootstrap.log"
    apt-config dump Acquire::http Acquire::https Acquire::Check-Date Acquire::Check-Valid-Until \
      >"$root/etc/apt/apt.conf.d/99machine"
    chroot "$root" useradd --create-home --shell /bin/bash user
    echo "user ALL=(ALL) NOPASSWD: ALL" >"$root/etc/sudoers.d/user"
    touch "$root/made"
  fi
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
}

# in_root SUITE USER COMMAND...: in mount and process namespaces of their own, so that nothing stays mounted or running.
in_root() {
  local root=$roots/$1 user=$2 home=/home/$2 path=/usr/local/bin:/usr/bin:/bin
  shift 2
  [ "$user" != root ] || home=/root path=/usr/local/sbin:/usr/sbin:/sbin:$path
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$0/proc"
    mount --rbind /dev "$0/dev"
    mount --rbind /sys "$0/sys"
    chroot --userspec="$1" "$0" "${@:2}"' "$root" "$user" \
    env -i HOME="$home" PATH="$path" LANG=C.UTF-8 bash -euc "cd && $*" </dev/null
}

# try SUITE USER COMMAND...: says how long it took and how it ended; what it printed is in a file beside the root.
try() {
  local suite=$1 user=$2 began=$SECONDS code=0 log
  shift 2
  log=$roots/$suite.$(basename "${1%.sh}").log
  in_root "$suite" "$user" "cd rubatlas && $*" >"$log" 2>&1 || code=$?
  echo "$suite: $* as $user: $((SECONDS - began)) s, exit code $code; $(tail -n 1 "$log")"
  [ $code -eq 0 ] || { ended=1 && tail -n 40 "$log" | sed 's/^/    /'; }
}

ended=0
for suite in "${suites[@]}"; do
  user=user clone=$roots/$suite/home/user/rubatlas
  [ "$suite" = bookworm ] || user=root clone=$roots/$suite/root/rubatlas
  began=$SECONDS
  make_root "$suite"
  rm -rf --one-file-system "$clone"
  git clone --quiet "file://$source" "$clone"
  in_root "$suite" root "chown -R $user: ~$user/rubatlas"
  echo "$suite: root in $((SECONDS - began)) s"
  for command in "${commands[@]}"; do
    case $command in
      quickstart) try "$suite" "$user" ./jobs/quickstart.sh ;;
      tests) try "$suite" "$user" ./tests/run.sh "${for_run[@]}" ;;
    esac
  done
  # shellcheck disable=SC2016
  in_root "$suite" "$user" 'echo "'"$suite"': $(. /etc/os-release; echo "$PRETTY_NAME $(cat /etc/debian_version)"),' \
    'GCC $(g++ -dumpfullversion), $(mpirun --version | head -n 1),' \
    'HDF5 $(dpkg-query -W -f "\${Version}" libhdf5-openmpi-dev),' \
    '$(python3 --version), WebAssembly by $(dpkg-query -W -f "\${Package} " "libc++-[0-9]*-dev-wasm32")"' || ended=1
done
exit $ended
