#!/usr/bin/env bash
# Installs what is missing, builds, and serves: ./deploy/run.sh [options of `froxel serve`].
# Without options: the built-in scene on http://127.0.0.1:8080, on whatever Vulkan device there is.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

require_packages "${build_packages[@]}" "${run_packages[@]}"
build_page_and_binary release
exec "$root/build/release/froxel" serve "$@"
