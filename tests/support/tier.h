// Tests run in two tiers (deploy/test.sh): usually every behaviour once; with FROXEL_TESTS=all what
// repeats it at greater length, too.
#pragma once

#include <cstdlib>
#include <string_view>

namespace froxel::test {

// Whether a grid of settings is gone through as a whole, beyond what tells its rules apart.
inline bool wholeGrids() {
    const char* tests = std::getenv("FROXEL_TESTS");
    return tests != nullptr && std::string_view(tests) == "all";
}

} // namespace froxel::test
