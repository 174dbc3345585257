#!/usr/bin/env bash
# Installs what is missing, builds the libFuzzer targets of tests/fuzz with clang's address and
# undefined-behaviour sanitizers, and runs each (or those named) for MINUTES, two at a time. What was
# learnt stays in build/fuzz/corpus; what went wrong lies in build/fuzz/findings, and the exit code is 1.
#
# Usage: fuzz.sh [MINUTES (10)] [NAME...]
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

minutes=${1:-10}
[[ $minutes =~ ^[0-9]+(\.[0-9]+)?$ ]] || die "MINUTES is '$minutes'; expected a number, such as 10 or 0.5"
seconds=$(awk "BEGIN { print int($minutes * 60) }")
cd "$root"
names=("${@:2}")
((${#names[@]})) || mapfile -t names < <(ls tests/fuzz/corpus)
for name in "${names[@]}"; do
    [[ -d tests/fuzz/corpus/$name ]] || die "there is no target $name, only: $(cd tests/fuzz/corpus && echo *)"
done

require_packages "${build_packages[@]}" clang libclang-rt-dev
install_node_modules
[[ -f build/fuzz/build.ninja ]] || cmake --preset fuzz >&2
cmake --build --preset fuzz --parallel "$(job_count)" --target "${names[@]/#/fuzz_}" >&2
mkdir -p build/fuzz/findings build/fuzz/logs

# Files are as large as a message may be; a single input that takes 20 s is a finding.
fuzz() { # NAME
    mkdir -p "build/fuzz/corpus/$1"
    UBSAN_OPTIONS=print_stacktrace=1 nice -n 10 "build/fuzz/tests/fuzz/fuzz_$1" \
        "build/fuzz/corpus/$1" "tests/fuzz/corpus/$1" -max_total_time="$seconds" -max_len=65536 \
        -timeout=20 -rss_limit_mb=4096 -artifact_prefix="build/fuzz/findings/$1-" \
        -print_final_stats=1 >"build/fuzz/logs/$1" 2>&1
}

tell() { # NAME
    local log=build/fuzz/logs/$1
    local runs edges
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    edges=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1)
    say "$1: ${runs:-?} runs, ${edges:-cov: ?}"
}

failed=()
for ((i = 0; i < ${#names[@]}; i += 2)); do
    jobs=()
    for name in "${names[@]:i:2}"; do
        fuzz "$name" &
        jobs+=("$!:$name")
    done
    for job in "${jobs[@]}"; do
        name=${job#*:}
        if wait "${job%%:*}"; then
            tell "$name"
        else
            failed+=("$name")
            tail -n 40 "build/fuzz/logs/$name" >&2
            say "$name: a finding, see build/fuzz/findings" >&2
        fi
    done
done
((${#failed[@]} == 0)) || die "findings in: ${failed[*]}"
say "no finding in $minutes minutes each of ${names[*]}"
