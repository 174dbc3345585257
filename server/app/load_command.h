// `froxel load`: viewers that measure a server.
#pragma once

#include "load/target.h"
#include "settings/settings.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace froxel::app {

struct LoadOptions {
    std::string url; // as given
    load::Target target;
    uint32_t viewer_count = 1;
    double seconds = 10;
    std::string script = "orbit"; // or idle, storm, a .jsonl file
    double ramp_s = 0;
    std::optional<double> max_latency_ms; // of each viewer, see load_verdict.h
    std::optional<double> min_fps;        // of each viewer
    std::optional<settings::Size> size;   // absent: the server's
    std::optional<uint32_t> light_count;  // likewise
    settings::Codec codec = settings::kPlainCodec;
    std::optional<uint32_t> video_kbps;    // of a video codec; absent: the server's
    std::string room;                      // shared by all viewers; empty: none
    std::filesystem::path token_file;      // empty: no token is shown
    std::filesystem::path tls_authorities; // empty: the system's
    std::filesystem::path json;            // empty: none
};

// Prints a table to stdout, progress to stderr where that is a terminal. SIGINT or SIGTERM ends it
// early, with what was measured so far; a second one ends the process at once. Returns 0, or 130
// when stopped. Throws StartupError: kInvalidArgument (script, tokens), kIo (a viewer failed or a
// bound is broken, said in one line after the table; a file).
[[nodiscard]] int runLoad(const LoadOptions& options);

} // namespace froxel::app
