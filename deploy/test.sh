#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test: C++ (ctest), the page's unit tests, types
# and lint, and the page in a browser. Every stage runs even if one fails. Closes with a line
# "N passed, N failed"; exit code 0 only if nothing failed.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

reports=$root/build/reports
stages=$reports/stages.tsv
executables=$root/build/test/gtest # the reports of tests/CMakeLists.txt

# Runs a command and notes its name, exit code and seconds; its JUnit report is reports/NAME.xml.
stage() { # NAME COMMAND...
    local start=$SECONDS code=0
    say "$1 ..."
    "${@:2}" || code=$?
    printf '%s\t%d\t%d\n' "$1" "$code" "$((SECONDS - start))" >>"$stages"
}

# Runs an npm script that is Vitest.
client_tests() { # STAGE SCRIPT
    stage "$1" npm --prefix client-web run --silent "$2" -- \
        --reporter=default --reporter=junit --outputFile.junit="$reports/$1.xml"
}

cd "$root"
require_packages "${build_packages[@]}" "${run_packages[@]}" "${test_packages[@]}"
rm -rf "$reports" "$executables"
mkdir -p "$reports"
build_page_and_binary test
say "built in $SECONDS s"

FROXEL_BINARY=$root/build/test/froxel
CHROMIUM=$(command -v chromium)
export FROXEL_BINARY CHROMIUM
stage ctest ctest --preset check --parallel "$(nproc)" --output-junit "$reports/ctest.xml"
stage lint npm --prefix client-web run --silent lint
client_tests vitest test
client_tests e2e e2e

exec python3 "$root/deploy/summarize_tests.py" "$reports" "$executables"
