#!/usr/bin/env bash
# Builds deploy/Dockerfile where no registry can be reached and no daemon runs: by buildah, on a base that
# debootstrap makes under the same name. Then opens a device with it, as the image's user. As root, on Debian:
#   ./deploy/try_image.sh [FOLDER]
# With FOLDER, which has /usr/local/bin/froxel and its web/, the build stage is left out.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

base=docker.io/library/debian:12-slim
work=$(mktemp -d /var/tmp/froxel-image.XXXXXX)
containers=()
cleanup() {
    ((${#containers[@]} == 0)) || builder rm "${containers[@]}" >/dev/null || true
    rm -rf "$work"
}
trap cleanup EXIT

builder() {
    buildah --root "$work/storage" --runroot "$work/run" --storage-driver vfs "$@"
}

# Chroot isolation gives a container this host's /proc and /sys as they are, which is enough here. What
# this host trusts, npm does there too.
build() {
    builder bud --isolation chroot --pull=never --format docker --file "$root/deploy/Dockerfile" --tag froxel \
        --volume /etc/ssl/certs/ca-certificates.crt:/opt/authorities.crt:ro \
        --build-arg NODE_EXTRA_CA_CERTS=/opt/authorities.crt "$@" "$root"
}

require_packages buildah
make_debian bookworm "$work/base"
# What the slim image leaves out, too; it keeps copyright files.
rm -rf "$work/base"/{var/cache/apt/*,var/lib/apt/lists/*,usr/share/{man,info,locale}/*}
find "$work/base/usr/share/doc" -type f ! -name copyright -delete
scratch=$(builder from scratch)
containers+=("$scratch")
builder copy --quiet "$scratch" "$work/base" / >/dev/null
builder commit --quiet "$scratch" "$base" >/dev/null
rm -rf "$work/base"

say "building"
if (($# > 0)); then
    prebuilt=$(builder from scratch)
    containers+=("$prebuilt")
    builder copy --quiet "$prebuilt" "$1" /out >/dev/null
    linked_packages "$1/usr/local/bin/froxel" >"$work/linked_packages.txt"
    builder copy --quiet "$prebuilt" "$work/linked_packages.txt" /linked_packages.txt >/dev/null
    build --build-context "build=container-image://$(builder commit --quiet "$prebuilt" localhost/build)"
else
    build
fi

trial=$(builder from --pull=never froxel)
containers+=("$trial")
size=$(du -sm --apparent-size "$(builder mount "$trial")" | cut -f 1)
base_container=$(builder from --pull=never "$base")
containers+=("$base_container")
base_size=$(du -sm --apparent-size "$(builder mount "$base_container")" | cut -f 1)
say "opening the device with it"
builder run --isolation chroot "$trial" -- froxel info --device cpu
say "the image has $size MB, of which the base $base_size MB"
