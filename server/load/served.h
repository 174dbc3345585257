// What a server says it serves, so that a report can tell what it measured.
#pragma once

#include "froxel/v1/server.pb.h"

#include <cstdint>
#include <string>

namespace froxel::load {

// Texts are the server's, made printable; names are those of the command line.
struct Served {
    std::string server_version;
    std::string device;
    std::string scene; // its name alone, without a folder
    uint32_t triangle_count = 0;
    uint32_t width_px = 0; // asked for
    uint32_t height_px = 0;
    uint32_t light_count = 0; // seeded
    bool lights_move = false;
    std::string renderer;
    std::string codec;
    uint32_t quality = 0;    // JPEG's
    uint32_t video_kbps = 0; // of a video codec
    bool operator==(const Served&) const = default;
};

// Pure.
[[nodiscard]] Served servedOf(const v1::Welcome& welcome, const v1::ViewState& state);

} // namespace froxel::load
