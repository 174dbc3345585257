// One GET, as a health check makes it.
#pragma once

#include "core/error.h"
#include "load/target.h"

#include <chrono>
#include <string>

namespace froxel::load {

struct ProbeAnswer {
    unsigned status = 0;
    std::string line; // the body's first
};

// Errors: kIo, in one line: no connection, or no answer in time.
[[nodiscard]] Result<ProbeAnswer> probe(const Target& target, std::chrono::milliseconds timeout);

} // namespace froxel::load
