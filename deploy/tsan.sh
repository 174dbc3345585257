#!/usr/bin/env bash
# Installs what is missing, builds with the thread sanitizer, and runs every test that needs no
# device and has more than one thread. Exit code 0 only if all passed; the first report ends a test.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

# Not what measures resident memory, which the sanitizer multiplies, nor what starts a whole server on
# a Vulkan device, which is too slow under it.
left_out='*MemoryBounded:*.Process_*'

tests=(core guest session stream still net load encode)
targets=("${tests[@]/%/_test}" relay_test integration_test)

cd "$root"
require_packages "${build_packages[@]}" "${test_packages[@]}"
install_node_modules
[[ -f build/tsan/build.ninja ]] || cmake --preset tsan >&2
cmake --build --preset tsan --parallel "$(job_count)" --target "${targets[@]}" >&2

export TSAN_OPTIONS="halt_on_error=1 second_deadlock_stack=1 ${TSAN_OPTIONS:-}"
failed=()
for target in "${targets[@]}"; do
    binary=$(find build/tsan/tests -type f -name "$target" -perm -u+x)
    say "$target ..."
    "$binary" --gtest_brief=1 --gtest_filter="-$left_out" || failed+=("$target")
done
((${#failed[@]} == 0)) || die "failed: ${failed[*]}"
say "${#targets[@]} passed"
