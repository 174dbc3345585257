// `froxel bench`: frame times against errors, over sweeps of settings.
#pragma once

#include "gpu/device_options.h"
#include "settings/settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct BenchOptions {
    bool list = false;                          // print the presets, and nothing else
    std::vector<std::filesystem::path> compare; // two results to compare, and nothing else
    std::vector<std::filesystem::path> join;    // results to write as one, and nothing else
    std::vector<std::string> presets;           // none: bench::fullPresetNames()
    std::string scene = "builtin";
    std::filesystem::path environment_file; // of light from around; empty: none
    gpu::DeviceOptions device;
    settings::ViewSettings settings;  // what no sweep varies, but for the camera
    std::filesystem::path light_set;  // that settings.lights.placed was read from; empty: none
    std::vector<std::string> cameras; // none: the scene's first three
    std::string path;                 // instead of cameras, as --path has it; empty: none
    double path_seconds = 10;         // of a built-in path
    uint32_t path_stops = 8;          // at even times of the path
    double seconds_per_row = 10;
    settings::Size error_size{640, 360};
    std::optional<double> r1_pairs_limit; // none: by the device's kind
    std::optional<double> r2_pairs_limit;
    std::filesystem::path out;    // JSON
    std::filesystem::path report; // HTML; empty: none
    std::filesystem::path web_root;
};

// Stopped by SIGINT or SIGTERM; what was measured is written.
inline constexpr int kStoppedExitCode = 130;

// The exit code: 0; 1 where a row's R1 error is not 0, or b is worse than a in a comparison;
// kStoppedExitCode. Throws StartupError.
[[nodiscard]] int runBench(const BenchOptions& options);

} // namespace froxel::app
