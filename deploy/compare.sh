#!/usr/bin/env bash
# Looks at froxel's pictures of glTF files; installs and builds what is missing. Results lie in build/compare.
#
# Usage: compare.sh three [--write] [FILE...]   beside those of three.js in headless Chromium, by LDR-FLIP; without
#                                               FILE, of generated files and of ../shared/scenes/models; --write
#                                               puts the table into docs/figures/three.md
#        compare.sh sheet FOLDER [OPTION...]    a contact sheet of all files of a folder, at default settings or with
#                                               options of froxel render
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

[[ ${1:-} == three || ${1:-} == sheet ]] || die "'${1:-}' is none of: three, sheet"
require_packages "${build_packages[@]}" "${run_packages[@]}" "${test_packages[@]}"
(
    cd "$root"
    [[ -f build/test/build.ninja ]] || cmake --preset test >&2
    cmake --build --preset test --parallel "$(job_count)" --target froxel picture_numbers feature_scenes >&2
)
install_node_modules
CHROMIUM=$(command -v chromium)
export CHROMIUM
exec npm --prefix "$root/client-web" run --silent "compare:$1" -- "${@:2}"
