#!/bin/bash
# Installs what is missing, builds with warnings as errors, and runs every test:
#
#   ./tests/run.sh               everything
#   ./tests/run.sh --quick       without clang-tidy and the tests labelled "slow"
#   ./tests/run.sh --sanitize    the suites below MPI, under the address and undefined-behaviour sanitizers
#
# The last line is "N passed, N failed"; the exit code is 0 only where nothing failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build
configure=(-DRUBATLAS_TESTS=ON -DRUBATLAS_WARNINGS_AS_ERRORS=ON)
choose=()
case "$#,${1-}" in
  0,) ;;
  1,--quick) choose=(-LE 'tidy|slow') ;;
  1,--sanitize)
    build=build-sanitize
    configure+=(-DCMAKE_BUILD_TYPE=RelWithDebInfo -DRUBATLAS_SANITIZE=address,undefined)
    choose=(-L '^(scene|plan|blade|contact|rotor|effects|integrate|observables|solve|atlas|analysis)$' -LE slow)
    ;;
  *)
    sed -n '2,8s/^# \{0,1\}//p' tests/run.sh
    [ "${1-}" = --help ] && exit 0 || exit 2
    ;;
esac
say() { printf '\n== %s\n' "$*"; }

say "Packages"
./jobs/install.sh --tests

say "Build, in $build/, warnings as errors"
generator=()
[ -e "$build/CMakeCache.txt" ] || generator=(-G Ninja)
cmake -S . -B "$build" "${generator[@]}" "${configure[@]}"
cmake --build "$build" --parallel "$(nproc)"

say "Tests"
. jobs/mpi_environment.sh
report=$build/tests.xml
rm -f "$report"
code=0
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error \
  --output-junit "$PWD/$report" "${choose[@]}" </dev/null || code=$?

say "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s"
# The counts are those of ctest's own report; a test that did not run has not passed.
/usr/bin/python3 - "$report" "$code" <<'COUNT'
import sys
import xml.etree.ElementTree as tree

suite = tree.parse(sys.argv[1]).getroot()
total, passed = int(suite.get("tests")), sum(case.get("status") == "run" for case in suite.iter("testcase"))
failed = total - passed
for case in suite.iter("testcase"):
    if case.get("status") != "run":
        print(f"failed: {case.get('name')}")
print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed or total == 0 or int(sys.argv[2]) else 0)
COUNT
