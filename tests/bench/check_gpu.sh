#!/usr/bin/env bash
# What lavapipe passes, on a GPU: every suite that draws, pictures of all lights against lists, storms of settings with
# the validation layer, and the hostile viewers where Python has the module websockets.
#   ./tests/bench/check_gpu.sh PACK OUT      PACK: of pack_gpu.sh, as a file or unpacked; OUT: a folder for logs
# FROXEL_STORM_MINUTES: of a storm, 3 unless set; FROXEL_AT_ONCE: suites at a time, a third of the processors unless set.
# Needs a Vulkan driver, and for storms Python 3. Closes with "N passed, N failed, N skipped"; exit code 1 where a test
# failed.
set -euo pipefail
pack=$1
out=$2
mkdir -p "$out"
rm -f "$out"/*.log "$out"/*.counts
if [[ -f $pack ]]; then
    unpacked=$(mktemp -d)
    trap 'rm -rf "$unpacked"' EXIT
    tar -xJf "$pack" -C "$unpacked"
    pack=$unpacked/gpu
fi
pack=$(cd "$pack" && pwd)
froxel=$pack/bin/froxel
export LD_LIBRARY_PATH=$pack/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export VK_LAYER_PATH=$pack/layer FROXEL_TEST_DEVICE=gpu
export FROXEL_REPOSITORY=$pack/repository FROXEL_BINARY=$froxel XDG_CACHE_HOME=$out/cache
# As many at once as a GPU's time is worth sharing: the host's parts of most take longer than what they draw.
at_once=$(($(nproc) / 3))
at_once=${FROXEL_AT_ONCE:-$((at_once < 1 ? 1 : at_once > 5 ? 5 : at_once))}
begin=$SECONDS

tell() { # NAME PASSED FAILED SKIPPED SECONDS [WHY]
    echo "$2 $3 $4" >"$out/$1.counts"
    printf '%-28s %4d passed %3d failed %3d skipped %4d s%s\n' "$1" "$2" "$3" "$4" "$5" "${6:+  $6}"
}

counted() { # KIND LOG: of gtest's closing lines, "[  PASSED  ] 12 tests."
    awk -v kind="$1" '$2 == kind && $4 ~ /^[0-9]+$/ && $5 ~ /^tests?/ { n = $4 } END { print n + 0 }' "$2"
}

suite() { # BINARY
    local name=${1##*/} start=$SECONDS code=0 failed why=
    local log=$out/$name.log
    timeout 330 "$1" >"$log" 2>&1 || code=$?
    failed=$(counted FAILED "$log")
    if ((code != 0 && failed == 0)); then
        failed=1
        why="ended with $code in $(grep '^\[ RUN' "$log" | tail -1)"
    fi
    tell "$name" "$(counted PASSED "$log")" "$failed" "$(counted SKIPPED "$log")" $((SECONDS - start)) "$why"
    sed -nE '/^\[  FAILED  \] [A-Z].*[a-z]$/s/^/    /p; /: Skipped$/{n;s/^/    skipped: /p}' "$log" | sort -u
}

# forward_plus must be naive bit for bit, in pictures larger than the suites': from one camera and from random ones.
lists() { # SCENE NAME CAMERA LIGHT_BOX
    local name=lists.$2 start=$SECONDS log=$out/lists.$2.log
    if ! command -v python3 >/dev/null; then
        tell "$name" 0 0 1 0 "no python3"
        return
    fi
    python3 "$pack/repository/tests/bench/compare_lists.py" "$froxel" "$1" --camera="$3" --light-box="$4" \
        --random 50 --at-once 4 >"$log" 2>&1 || true
    read -r equal differ < <(sed -nE 's/^([0-9]+) equal, ([0-9]+) differ$/\1 \2/p' "$log" | grep . || echo 0 1)
    tell "$name" "$equal" "$differ" 0 $((SECONDS - start))
    sed '$d; s/^/    /' "$log"
}

# Viewers come and go with every setting over its whole range: nothing is held on to, no message of the layer.
storm() { # SCENE NAME
    local name=storm.$2 start=$SECONDS log=$out/storm.$2.log options=(--device gpu --scene "$1" --size 640x360)
    if ! command -v python3 >/dev/null; then
        tell "$name" 0 0 1 0 "no python3"
        return
    fi
    [[ -f $pack/layer/VkLayer_khronos_validation.json ]] && options+=(--validation)
    if python3 "$pack/repository/tests/load/soak.py" "$froxel" --minutes "${FROXEL_STORM_MINUTES:-3}" --scripts storm -- "${options[@]}" >"$log" 2>&1 &&
        ! grep -q 'validation:' "$log"; then
        tell "$name" 1 0 0 $((SECONDS - start)) "$(grep -c . "$log") lines"
    else
        tell "$name" 0 1 0 $((SECONDS - start)) "$(grep -m1 'validation:' "$log" || tail -1 "$log")"
    fi
}

hostile() {
    local start=$SECONDS log=$out/hostile.log python=${FROXEL_HOSTILE_PYTHON:-python3} held failed
    if ! "$python" -c 'import websockets' 2>/dev/null; then
        tell hostile 0 0 1 0 "$python has no module websockets"
        return
    fi
    "$python" "$pack/repository/tests/hostile/hostile.py" "$froxel" --out "$out/hostile.json" \
        -- --device gpu --size 1280x720 --lights 1000 >"$log" 2>&1 || true
    held=$(grep -c '"holds": true' "$out/hostile.json" || true)
    failed=$(grep -c '"holds": false' "$out/hostile.json" || true)
    tell hostile "${held:-0}" "${failed:-1}" 0 $((SECONDS - start))
}

wait_for_place() {
    while (($(jobs -rp | wc -l) >= at_once)); do
        wait -n || true
    done
}

"$froxel" info --device gpu | sed '/^service:/,$d' | tee "$out/info.log"
storm "$pack/shared/scenes/models/chess-board/chess-board.glb" coats &
storm "$pack/shared/scenes/models/fox/Fox.glb" animation &
dearest=(hard render_exactness render_reference render_variants render_shading)
for binary in "${dearest[@]/#/$pack/bin/}" "$pack"/bin/*_test; do
    binary=${binary%_test}_test
    [[ -f $out/${binary##*/}.log ]] && continue # has begun
    wait_for_place
    : >"$out/${binary##*/}.log"
    suite "$binary" &
done
wait_for_place
lists builtin hall Nave "-10,0,-5;10,8,5" &
sponza=${FROXEL_SPONZA:-$pack/shared/scenes/sponza/Sponza.gltf}
if [[ -f $sponza ]]; then
    wait_for_place
    lists "$sponza" sponza "-7,2,0;0,2,0;45" "-10,0,-5;10,8,5" &
fi
wait
hostile # by itself: it measures

read -r passed failed skipped < <(cat "$out"/*.counts | awk '{ p += $1; f += $2; s += $3 } END { print p + 0, f + 0, s + 0 }')
echo "$(sed -n 's/^  name: //p' "$out/info.log"), $(date -u +%F), $((SECONDS - begin)) s:" \
    "$passed passed, $failed failed, $skipped skipped"
exit "$((failed > 0))"
