#!/usr/bin/env bash
# Installs packages, builds, and runs every test: C++ (ctest), the page's unit tests, types and lint,
# the language of documents and messages, and the page in a browser. Every stage runs even if one fails.
# Ends with the duration of each stage and a line "N passed, N failed"; exit code 0 only if nothing failed.
#   ./deploy/test.sh        every behaviour at least once
#   ./deploy/test.sh all    also the exhaustive tests (tests/support/tier.h, ctest's configuration "all")
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

reports=$root/build/reports
stages=$reports/stages.tsv
executables=$root/build/test/gtest # the reports of tests/CMakeLists.txt

# Notes a stage for summarize_tests.py; AIM: the seconds that it may take on two cores with nothing cached.
note() { # NAME CODE SINCE AIM
    printf '%s\t%s\t%d\t%d\n' "$1" "$2" "$((SECONDS - $3))" "$4" >>"$stages"
}

# Runs a command as a stage; its JUnit report is reports/NAME.xml.
stage() { # NAME AIM COMMAND...
    local start=$SECONDS code=0
    say "$1 ..."
    "${@:3}" || code=$?
    note "$1" "$code" "$start" "$2"
}

check_prose() {
    install_node_modules tests/docs
    "$root/tests/docs/check_prose.sh"
}

# Runs an npm script that is Vitest.
client_tests() { # STAGE AIM SCRIPT
    stage "$1" "$2" npm --prefix client-web run --silent "$3" -- \
        --reporter=default --reporter=junit --outputFile.junit="$reports/$1.xml"
}

[[ ${1:-} =~ ^(all)?$ && $# -le 1 ]] || die "unknown argument: $*; expected all, or nothing"
tests=${1:+all}

cd "$root"
require_packages "${build_packages[@]}" "${run_packages[@]}" "${test_packages[@]}"
rm -rf "$reports" "$executables"
mkdir -p "$reports"
since=$SECONDS
build_page_and_binary test
note build - "$since" 620

FROXEL_BINARY=$root/build/test/froxel
CHROMIUM=$(command -v chromium)
export FROXEL_BINARY CHROMIUM
stage ctest 400 ctest --preset "${tests:-check}" --parallel "$(($(nproc) + 1))" --output-junit "$reports/ctest.xml"
stage lint 15 npm --prefix client-web run --silent lint
stage prose 60 check_prose
client_tests vitest 15 test
client_tests e2e 150 e2e

exec python3 "$root/deploy/summarize_tests.py" "$reports" "$executables"
