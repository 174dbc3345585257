// The enumerators of an enum as a list that none can be missing from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace froxel {

// From 0 to `last`, in their order. `known` says of each whether it is one, by a switch over all of
// them without a default: -Wswitch refuses to compile it where one is forgotten.
template <class Enum, uint32_t last, bool (*known)(Enum)>
[[nodiscard]] constexpr auto enumerators() {
    constexpr auto count = [] {
        size_t found = 0;
        for (uint32_t value = 0; value <= last; ++value) {
            found += known(static_cast<Enum>(value)) ? 1U : 0U;
        }
        return found;
    }();
    std::array<Enum, count> all{};
    size_t next = 0;
    for (uint32_t value = 0; value <= last; ++value) {
        if (known(static_cast<Enum>(value))) {
            all[next++] = static_cast<Enum>(value);
        }
    }
    return all;
}

} // namespace froxel
