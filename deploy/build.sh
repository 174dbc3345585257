#!/usr/bin/env bash
# Installs what a build needs and makes the optimised binary and the page.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

require_packages "${build_packages[@]}"
build_page_and_binary release
say "built $root/build/release/froxel and $root/client-web/dist"
