#!/usr/bin/env bash
# Packs what check_gpu.sh needs on a machine that has only a Vulkan driver: the binary, the suites that draw, their
# libraries, the validation layer, and the scenes that are there.
#   ./tests/bench/pack_gpu.sh BUILD PACK.tar.xz [SCENE...]      SCENE: a folder of ../shared/scenes
# There: tar -xJf PACK.tar.xz && ./gpu/repository/tests/bench/check_gpu.sh gpu OUT
set -euo pipefail
build=$1
pack=$2
kept=("${@:3}")
(($# > 2)) || kept=(sponza models/fox models/chess-board)
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
gpu=$work/gpu
mkdir -p "$gpu"/{bin,lib,layer,repository/tests}

binaries=("$build/froxel" "$build"/tests/render/render_*_test "$build/tests/hard/hard_test"
    "$build/tests/unit/gpu/gpu_device_test")
for binary in "${binaries[@]}"; do
    [[ -f $binary && -x $binary ]] && strip -o "$gpu/bin/$(basename "$binary")" "$binary"
done
[[ -x $gpu/bin/froxel ]] || { echo "no froxel in $build: build the preset test" >&2; exit 1; }

# The layer of Debian's vulkan-validationlayers.
layer=$(ldconfig -p | awk '/libVkLayer_khronos_validation/ { print $NF; exit }')
manifest=/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json
layer=${layer:-/usr/lib/$(uname -m)-linux-gnu/libVkLayer_khronos_validation.so}
if [[ -f $layer && -f $manifest ]]; then
    cp "$layer" "$gpu/layer/"
    sed -E 's|"library_path": *"[^"]*"|"library_path": "./'"$(basename "$layer")"'"|' "$manifest" \
        >"$gpu/layer/$(basename "$manifest")"
fi

# All libraries but the C library's, which must be the machine's own; and the loader, which is opened by name.
ldd "$gpu"/bin/* "$gpu"/layer/*.so 2>/dev/null | awk '$3 ~ /^\// { print $3 }' | sort -u |
    grep -vE '/(libc|libm|libdl|librt|libpthread|libresolv)\.so|/ld-linux' |
    while read -r library; do cp -L "$library" "$gpu/lib/"; done
cp -L "$(ldconfig -p | awk '/libvulkan\.so\.1 / { print $NF; exit }')" "$gpu/lib/"

cp -r "$root"/tests/{hostile,load,support} "$gpu/repository/tests/"
mkdir "$gpu/repository/tests/bench"
cp "$root"/tests/bench/{check_gpu.sh,compare_lists.py} "$gpu/repository/tests/bench/"
# What the suites read beside the repository; they skip what is not there, and say so.
scenes=$root/../shared/scenes
for scene in "${kept[@]}"; do
    if [[ -d $scenes/$scene ]]; then
        mkdir -p "$gpu/shared/scenes/$(dirname "$scene")"
        cp -r "$scenes/$scene" "$gpu/shared/scenes/$scene"
    fi
done
# The binaries share most of their bytes, far apart.
XZ_OPT="${XZ_OPT:---lzma2=preset=1,dict=128MiB}" tar -C "$work" -cJf "$pack" gpu
du -h "$pack"
