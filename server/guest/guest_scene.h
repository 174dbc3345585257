// A guest scene: one that a client brings.
#pragma once

#include "core/file_descriptor.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace froxel::guest {

struct GuestFile {
    std::string name; // as the scene refers to it: its path with '/', untrusted bytes
    FileDescriptor descriptor;
    uint64_t size_bytes = 0;
};

struct GuestScene {
    std::vector<GuestFile> files; // at least one: the scene's own comes first
    std::string form_boundary{};  // the first is a form (RFC 7578) that has all; empty: it is none
    std::shared_ptr<const void> held{}; // let go with it: the room that it takes
};

} // namespace froxel::guest
