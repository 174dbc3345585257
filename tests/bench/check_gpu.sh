#!/usr/bin/env bash
# Checks and times a GPU: ./tests/bench/check_gpu.sh FROXEL OUT [SCENE.gltf]
# Draws every renderer on the built-in scene (and SCENE), requires forward_plus to equal naive bit for
# bit, and writes pictures and timings to OUT. Needs only the froxel binary and a Vulkan driver.
# FROXEL_ASSIGNMENT_TEST=render_gpu_assignment_test also compares the light lists that the GPU makes with
# the host's, entry by entry. FROXEL_HOSTILE_PYTHON=python3, one that has the module websockets, also plays
# tests/hostile, an honest viewer beside hostile ones.
set -euo pipefail
froxel=$1
out=$2
mkdir -p "$out"
failures=0

check() { # SCENE NAME LIGHTS STAGE [options]
    local scene=$1 name=$2 lights=$3 stage=$4 renderer
    shift 4
    for renderer in naive forward_plus; do
        "$froxel" render --device gpu --scene "$scene" --lights "$lights" --size 960x540 --warmup 0 \
            --renderer "$renderer" --lighting "$stage" --out "$out/$renderer.pfm" "$@" >/dev/null
    done
    if cmp -s "$out/naive.pfm" "$out/forward_plus.pfm"; then
        echo "equal: $name, $lights lights, $stage"
    else
        echo "DIFFERENT: $name, $lights lights, $stage: forward_plus is not naive"
        failures=$((failures + 1))
    fi
    rm -f "$out/naive.pfm" "$out/forward_plus.pfm"
}

measure() { # SCENE NAME LIGHTS RENDERER SIZE [options]
    local scene=$1 file=$out/$2_$3_$4_$5.json
    "$froxel" render --device gpu --scene "$scene" --lights "$3" --renderer "$4" --size "$5" \
        --frames 60 --warmup 10 --timings "$file" --out "${file%.json}.jpg" "${@:6}"
}

"$froxel" info --device gpu
if [ -n "${FROXEL_ASSIGNMENT_TEST:-}" ]; then
    FROXEL_TEST_DEVICE=gpu "$FROXEL_ASSIGNMENT_TEST" --gtest_filter='GpuAssignment.*' --gtest_brief=1 ||
        failures=$((failures + 1))
fi
scenes=("builtin|hall|--camera Nave")
if [ $# -ge 3 ]; then
    scenes+=("$3|sponza|--camera -7,2,0;0,2,0;45 --light-box -10,0,-5;10,8,5")
fi
for entry in "${scenes[@]}"; do
    IFS='|' read -r scene name text <<<"$entry"
    read -ra options <<<"$text"
    for lights in 0 7 1000; do
        check "$scene" "$name" "$lights" fragment "${options[@]}"
        check "$scene" "$name" "$lights" compute "${options[@]}"
    done
    for renderer in forward_plus clustered_deferred toon_fragment toon_compute; do
        measure "$scene" "$name" 1000 "$renderer" 1920x1080 "${options[@]}"
    done
    measure "$scene" "$name" 5000 clustered_deferred 1920x1080 "${options[@]}"
done
if [ -n "${FROXEL_HOSTILE_PYTHON:-}" ]; then
    "$FROXEL_HOSTILE_PYTHON" "$(dirname "$0")/../hostile/hostile.py" "$froxel" --out "$out/hostile.json" \
        -- --device gpu --size 1280x720 --lights 1000 || failures=$((failures + 1))
fi
exit "$((failures > 0))"
