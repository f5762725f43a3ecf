#!/bin/bash
# Installs what is missing, builds, and runs the tests:
#
#   ./tests/run.sh               every test but the slow ones
#   ./tests/run.sh --both        the same in two builds, as .ci/run does: what handles text, memory and files under the
#                                address and undefined-behaviour sanitizers, the rest with every index checked
#   ./tests/run.sh --full        the slow ones too, every suite below MPI in both builds, and both commands in new
#                                systems: a million revolutions, 10 000 random scenes, all of clang-tidy, headers alone;
#                                hours
#   ./tests/run.sh --sanitize    only what runs under the sanitizers
#   ./tests/run.sh --systems     quickstart and tests in minimal Debian 12 and 13 (tests/systems.sh; needs root)
#
# The last line is "N passed, N failed"; the exit code is 0 only where nothing failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# What runs under sanitizers: suites whose sources allocate, index and parse by themselves, with two builds there alone.
# What moves, and what is made of an atlas, would take minutes more to compile for them: it does so in --full, and with
# two builds the standard library checks its indices.
there_alone=(settings plan atlas)
sanitized_suites=("${there_alone[@]}")
level=-O0  # no time is spent in them
only_linked='integrate;blade;trajectory;contact;rotor;variation'  # what moves: no suite of these calls it
plain=yes
sanitized=no
systems=no
leave_out='slow'
left_out_plain=''
case "$#,${1-}" in
  0,) ;;
  1,--both)
    sanitized=yes
    left_out_plain=$(IFS=';'; echo "${there_alone[*]}")
    export CXXFLAGS="${CXXFLAGS-} -D_GLIBCXX_ASSERTIONS"
    ;;
  1,--full)
    sanitized=yes
    leave_out='no such label'
    level=-O1
    only_linked=''
    sanitized_suites+=(analysis assembly blade contact rotor integrate observables collocation point physics hard
                       effects)
    systems=yes
    ;;
  1,--sanitize) plain=no sanitized=yes ;;
  1,--systems) exec tests/systems.sh ;;
  *)
    sed -n '2,14s/^# \{0,1\}//p' tests/run.sh
    [ "${1-}" = --help ] && exit 0 || exit 2
    ;;
esac
say() { printf '\n== %s (after %d s)\n' "$*" "$SECONDS"; }

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
  ctest --test-dir "$build" --parallel "$(($(nproc) + 1))" --output-on-failure --no-tests=error \
    --output-junit "$report" --test-output-size-passed 1000000 "$@" </dev/null || true
}
# configure BUILD ARGUMENTS...: Ninja where the tree is new.
configure() {
  local build=$1 generator=()
  shift
  [ -e "$build/CMakeCache.txt" ] || generator=(-G Ninja)
  cmake -S . -B "$build" "${generator[@]}" -DRUBATLAS_TESTS=ON "$@"
}

if [ "$plain" = yes ]; then
  say "Build, in build/"
  configure build -DRUBATLAS_TESTS_LEFT_OUT="$left_out_plain"
  cmake --build build --parallel "$(nproc)"
fi
if [ "$sanitized" = yes ]; then
  say "Build with address and undefined-behaviour sanitizers, in build-sanitize/"
  # Clang: a second compiler's opinion, in less than half of GCC's time under sanitizers.
  configure build-sanitize -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=$level" \
    -DRUBATLAS_SANITIZE=address,undefined -DRUBATLAS_ONLY_LINKED="$only_linked"
  # It gives way to the tests below but goes on beside them: at their end its last files would wait for each other.
  nice -n 5 cmake --build build-sanitize --parallel "$(nproc)" --target "${sanitized_suites[@]/#/test_}" \
    >build-sanitize/build.log 2>&1 &
  compiling=$!
fi
if [ "$plain" = yes ]; then
  run_tests build -LE "$leave_out"
fi
if [ "$sanitized" = yes ]; then
  compiled=0
  wait "$compiling" || compiled=$?
  cat build-sanitize/build.log
  [ "$compiled" = 0 ] || exit "$compiled"
  run_tests build-sanitize -L "^($(IFS='|'; echo "${sanitized_suites[*]}"))(-|\$)" -LE "$leave_out"
fi

systems_failed=0
if [ "$systems" = yes ]; then
  say "Quickstart and tests in new systems"
  tests/systems.sh || systems_failed=1
fi

say "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s"
# The counts are those of the tests in the processes of ctest's reports. What did not run has not passed.
/usr/bin/python3 - "$systems_failed" "${reports[@]}" <<'COUNT'
import re
import sys
import xml.etree.ElementTree as tree

passed, failed = 0, int(sys.argv[1])
complete = True
for report in sys.argv[2:]:
    try:
        suite = tree.parse(report).getroot()
    except (OSError, tree.ParseError) as error:
        print(f"failed: no report {report}: {error}")
        complete = False
        continue
    cases = list(suite.iter("testcase"))
    complete = complete and int(suite.get("tests")) == len(cases) > 0
    for case in cases:
        said = case.findtext("system-out") or ""
        # A process of C++ tests says how many passed, and names those that failed as they do.
        of_suite = re.search(r"^\[  PASSED  \] (\d+) tests?\.", said, re.MULTILINE)
        missed = len(re.findall(r"^\[  FAILED  \] .* \(\d+ ms\)$", said, re.MULTILINE)) if of_suite else 0
        # A class of Python tests says how many ran, and how many of them were skipped or failed.
        ran = re.search(r"^Ran (\d+) tests? in .*", said, re.MULTILINE | re.DOTALL)
        methods = int(of_suite[1]) + missed if of_suite else int(ran[1]) if ran else 1
        of = dict(re.findall(r"(failures|errors|skipped)=(\d+)", ran[0])) if ran else {}
        for name, reason in re.findall(r"^(\w+) .* skipped (.*)$", said, re.MULTILINE) if "skipped" in of else []:
            print(f"skipped: {case.get('name')}.{name}: {reason}")
        missed += int(of.get("failures", 0)) + int(of.get("errors", 0))
        if case.get("status") != "run" or methods == 0:
            print(f"failed: {case.get('name')}")
            missed = max(1, missed)
        failed += missed
        passed += max(0, methods - missed - int(of.get("skipped", 0)))
print(f"{passed} passed, {failed} failed")
sys.exit(0 if complete and failed == 0 else 1)
COUNT
