#!/usr/bin/env bash
# Builds deploy/Dockerfile for a registry and pushes it: on a base that is named by its digest, with an SBOM
# and provenance as attestations. Needs docker with buildx.
#   ./deploy/image.sh REGISTRY/froxel:TAG [docker.io/library/debian:12-slim@sha256:...]
# Without a digest the tag's present one is taken, and printed.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

(($# == 1 || $# == 2)) || die "usage: image.sh REGISTRY/froxel:TAG [BASE@sha256:DIGEST]"
base=${2:-docker.io/library/debian:12-slim}
if [[ $base != *@* ]]; then
    base+=@$(docker buildx imagetools inspect "$base" --format '{{.Manifest.Digest}}')
fi
[[ $base =~ @sha256:[0-9a-f]{64}$ ]] || die "base '$base' has no digest, such as debian:12-slim@sha256:..."
say "base $base"
docker buildx build --file "$root/deploy/Dockerfile" --tag "$1" --sbom=true --provenance=mode=max --push \
    --build-arg "DEBIAN=$base" --build-arg "VERSION=${1##*:}" \
    --build-arg "REVISION=$(git -C "$root" rev-parse HEAD)" "$root"
