// No exception leaves a handler: it would end the thread that serves every connection.
#pragma once

#include "core/text.h"

#include <spdlog/spdlog.h>

#include <exception>

namespace froxel::net {

// Runs `work`; an exception (out of memory, at most) is logged and false returned, upon which the
// caller gives up its connection.
template <class Work>
[[nodiscard]] bool guarded(const char* where, const Work& work) {
    try {
        work();
        return true;
    } catch (const std::exception& error) {
        spdlog::error("event=internal_error where=\"{}\" reason={}", where, logValue(error.what()));
        return false;
    }
}

// A thread of `io`, until that stops. Handlers guard themselves; this is for what none foresaw.
template <class Io>
void runGuarded(const char* where, Io& io) {
    while (!guarded(where, [&io] { io.run(); })) {
    }
}

} // namespace froxel::net
