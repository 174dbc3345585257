#include "render/device/memory_budget.h"

#include <spdlog/fmt/fmt.h>

namespace froxel::render {

namespace {

// Rounded up, so that what is refused never reads as equal to its limit.
uint64_t needMib(uint64_t bytes) {
    return (bytes >> 20U) + 1;
}

uint64_t limitMib(uint64_t bytes) {
    return bytes >> 20U;
}

// Errors: kCapacity where `bytes` beside those of others would pass the limit.
Result<void> fits(uint64_t bytes,
                  uint64_t others,
                  uint64_t limit,
                  const char* whose,
                  const std::string& picture) {
    if (bytes <= limit && others <= limit - bytes) {
        return {};
    }
    return Error{ErrorCode::kCapacity,
                 fmt::format("{} takes {} MiB of memory; scenes and other sessions use {} of the "
                             "{}'s {}; use a smaller picture, or try again later",
                             picture, needMib(bytes), needMib(others), whose, limitMib(limit)),
                 others < limit ? static_cast<double>(bytes) / static_cast<double>(limit - others)
                                : 0};
}

} // namespace

void SceneMemory::add(uint64_t bytes) {
    bytes_ += bytes;
    budget_.scene_bytes_ += bytes;
}

Result<void> SceneMemory::take(uint64_t bytes, const std::string& what) {
    auto room = fits(bytes, budget_.scene_bytes_ + budget_.views_.device_bytes,
                     budget_.limits_.device_bytes, "device", what);
    if (room) {
        add(bytes);
    }
    return room;
}

Result<void> MemoryShare::take(const MemoryTaken& need, const std::string& picture) {
    const MemoryLimits& limits = budget_.limits_;
    if (need.total() > limits.session_bytes) {
        return Error{
            ErrorCode::kCapacity,
            fmt::format("{} takes {} MiB of memory; a session may have {}; use a smaller picture",
                        picture, needMib(need.total()), limitMib(limits.session_bytes)),
            static_cast<double>(need.total()) / static_cast<double>(limits.session_bytes)};
    }
    const uint64_t others =
        budget_.scene_bytes_ + budget_.views_.device_bytes - taken_.device_bytes;
    const uint64_t others_host = budget_.views_.host_bytes - taken_.host_bytes;
    if (auto room = fits(need.device_bytes, others, limits.device_bytes, "device", picture);
        !room) {
        return room;
    }
    if (auto room = fits(need.host_bytes, others_host, limits.host_bytes, "host", picture); !room) {
        return room;
    }
    replace(need);
    return {};
}

void MemoryShare::replace(const MemoryTaken& taken) {
    budget_.views_.device_bytes += taken.device_bytes - taken_.device_bytes;
    budget_.views_.host_bytes += taken.host_bytes - taken_.host_bytes;
    taken_ = taken;
}

} // namespace froxel::render
