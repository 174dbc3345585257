// The machine and the build, as reports name them.
#pragma once

#include <string>

namespace froxel::report {

struct HostSummary {
    std::string cpu; // model, empty where the system does not say
    unsigned thread_count = 0;
    std::string build_type; // "release", or "debug" with the language's assertions on
    std::string compiler;
};

[[nodiscard]] HostSummary hostSummary();

} // namespace froxel::report
