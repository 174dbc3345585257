// Where a server listens.
#pragma once

#include <cstdint>
#include <string>

namespace froxel::net {

struct BindAddress {
    std::string address; // IPv4 or IPv6, no host names
    uint16_t port = 0;   // 0: any free one

    bool operator==(const BindAddress&) const = default;
};

} // namespace froxel::net
