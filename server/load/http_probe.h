// One GET, as a health check makes it. Without TLS.
#pragma once

#include "core/error.h"
#include "load/target.h"

#include <chrono>
#include <string>

namespace froxel::load {

struct ProbeAnswer {
    unsigned status = 0;
    std::string line; // the body's first, printable
    std::string body;
};

// Errors: kIo, in one line: no connection, or no answer in time.
// `token`: shown as Bearer; empty: none.
[[nodiscard]] Result<ProbeAnswer>
probe(const Target& target, std::chrono::milliseconds timeout, const std::string& token = {});

} // namespace froxel::load
