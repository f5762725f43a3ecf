#!/bin/bash
# Installs what is missing, builds with warnings as errors, and runs the tests:
#
#   ./tests/run.sh               every test but the slow ones; suites below MPI and the hard suite under the address and
#                                undefined-behaviour sanitizers, those of solver and hard cases in the plain build too
#   ./tests/run.sh --full        the slow ones too, and all in both builds: a million revolutions, 10 000 random scenes; hours
#   ./tests/run.sh --quick       without clang-tidy, slow tests and sanitizers
#   ./tests/run.sh --sanitize    only what runs under the sanitizers
#
# The last line is "N passed, N failed"; the exit code is 0 only where nothing failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Folders whose tests see the same under sanitizers, in the same minutes, as without.
lower=(settings plan blade contact rotor integrate observables atlas analysis)
upper=(assembly collocation point physics hard)
plain=yes
sanitized=yes
leave_out='slow'
left_out_plain=$(IFS=';'; echo "${lower[*]}")
# Sanitizers look at what is executed, not at how often. These run in the plain build alone: long runs, the
# methods that ours is compared with, and searches over many dampings, masses, tolerances or scenes, which pass through
# the same sources again and again, for minutes under sanitizers.
leave_out_sanitized='^(LongRun|StableClass|FixedMethod|PaperMethod|Orbits/PeriodicMotion|Compared/)'
leave_out_sanitized+='|^(RandomScenes\.OfThirtyBlades|Slip\.TipsThatMayStick|DampingAndSpeed\.EveryDamping)'
leave_out_sanitized+='|^(RingBodyOfAnyWeight|Grazing\.EachBlade|PlainRotor)|^First/RandomSearch.*/(0|50)_to_'
case "$#,${1-}" in
  0,) ;;
  1,--full)
    leave_out='no such label'
    left_out_plain=''
    leave_out_sanitized='^LongRunSlow'
    ;;
  1,--quick)
    sanitized=no
    leave_out='tidy|slow'
    left_out_plain=''
    ;;
  1,--sanitize) plain=no ;;
  *)
    sed -n '2,11s/^# \{0,1\}//p' tests/run.sh
    [ "${1-}" = --help ] && exit 0 || exit 2
    ;;
esac
say() { printf '\n== %s\n' "$*"; }

say "Packages"
./jobs/install.sh --tests
. jobs/mpi_environment.sh

reports=()
# run_tests BUILD ARGUMENTS...: what ctest chooses by the arguments, with a report in BUILD.
run_tests() {
  local build=$1 report=$PWD/$1/tests.xml
  shift
  say "Tests in $build/"
  rm -f "$report"
  reports+=("$report")
  ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error \
    --output-junit "$report" "$@" </dev/null || true
}
# configure BUILD ARGUMENTS...: Ninja where the tree is new.
configure() {
  local build=$1 generator=()
  shift
  [ -e "$build/CMakeCache.txt" ] || generator=(-G Ninja)
  cmake -S . -B "$build" "${generator[@]}" -DRUBATLAS_TESTS=ON -DRUBATLAS_WARNINGS_AS_ERRORS=ON "$@"
}

if [ "$plain" = yes ]; then
  say "Build, in build/, warnings as errors"
  # Several sources at once: most of the compiler's time goes into the headers of the libraries.
  configure build -DCMAKE_UNITY_BUILD=ON -DRUBATLAS_TESTS_TOGETHER=ON -DRUBATLAS_TESTS_LEFT_OUT="$left_out_plain"
  cmake --build build --parallel "$(nproc)"
  run_tests build -LE "$leave_out"
fi

if [ "$sanitized" = yes ]; then
  say "Build with address and undefined-behaviour sanitizers, in build-sanitize/"
  suites=("${lower[@]}" "${upper[@]}")
  [ "$leave_out" = slow ] || suites+=(effects)  # minutes of compiling
  # Clang: a second compiler's opinion, in less than half of GCC's time under sanitizers.
  configure build-sanitize -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 \
    -DRUBATLAS_SANITIZE=address,undefined -DCMAKE_UNITY_BUILD=ON -DRUBATLAS_TESTS_TOGETHER=ON
  cmake --build build-sanitize --parallel "$(nproc)" --target "${suites[@]/#/test_}"
  run_tests build-sanitize -L "^($(IFS='|'; echo "${suites[*]}"))(-|\$)" -LE "$leave_out" -E "$leave_out_sanitized"
fi

say "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s"
# The counts are those of ctest's own reports; a test that did not run has not passed.
/usr/bin/python3 - "${reports[@]}" <<'COUNT'
import sys
import xml.etree.ElementTree as tree

passed = failed = 0
complete = True
for report in sys.argv[1:]:
    try:
        suite = tree.parse(report).getroot()
    except (OSError, tree.ParseError) as error:
        print(f"failed: no report {report}: {error}")
        complete = False
        continue
    cases = list(suite.iter("testcase"))
    complete = complete and int(suite.get("tests")) == len(cases) > 0
    for case in cases:
        if case.get("status") == "run":
            passed += 1
        else:
            print(f"failed: {case.get('name')}")
            failed += 1
print(f"{passed} passed, {failed} failed")
sys.exit(0 if complete and failed == 0 else 1)
COUNT
