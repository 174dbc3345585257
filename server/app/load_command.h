// `froxel load`: viewers that measure a server.
#pragma once

#include "load/script.h"
#include "load/stages.h"
#include "load/target.h"
#include "settings/settings.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct LoadOptions {
    std::string url; // as given
    load::Target target;
    std::optional<uint32_t> thread_count; // that play viewers; absent: by their number
    std::optional<uint32_t> viewer_count; // absent: 1, or with `find` 10,000
    double seconds = 10;                  // with `find`, of each trial
    std::vector<std::string> scripts;     // NAME[:SHARE]; none: orbit
    std::optional<load::ThinkTime> think;
    double ramp_s = 0;
    std::vector<load::Stage> stages;       // none: viewer_count, over ramp_s
    std::vector<std::string> requirements; // load/requirement.h
    std::vector<std::string>
        find_requirements;    // that --find looks for the limit of; none: it is a plain run
    uint32_t trial_count = 3; // with `find`
    std::optional<double> stop_early_s;  // after a requirement has been broken for so long
    std::optional<settings::Size> size;  // absent: the server's
    std::optional<uint32_t> light_count; // likewise
    settings::Codec codec = settings::kPlainCodec;
    std::optional<uint32_t> video_kbps;    // of a video codec; absent: the server's
    std::string room;                      // shared by all viewers; empty: none
    bool depth = false;                    // viewers ask for it
    std::filesystem::path token_file;      // empty: no token is shown
    std::filesystem::path tls_authorities; // empty: the system's
    std::filesystem::path json;            // empty: none; so for the following
    std::filesystem::path series;          // .jsonl, .csv or .prom
    std::filesystem::path junit;
    std::filesystem::path histograms; // HdrHistogram's log
    std::filesystem::path report;     // HTML
    std::filesystem::path web_root;
};

// Prints a table to stdout, progress to stderr where that is a terminal. SIGINT or SIGTERM ends it
// early, with what was measured so far; a second one ends the process at once. Returns 0,
// kExitRequirement, or 130 when stopped. Throws StartupError: kInvalidArgument (script, tokens),
// kIo (a viewer failed, said in one line after the table; a file).
[[nodiscard]] int runLoad(const LoadOptions& options);

} // namespace froxel::app
