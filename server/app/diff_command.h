// `froxel diff`: how far pictures are apart.
#pragma once

#include "diff/difference.h"

#include <filesystem>

namespace froxel::app {

struct DiffOptions {
    std::filesystem::path picture; // a file, or a folder of pictures
    std::filesystem::path reference;
    diff::Limits limits;
    std::filesystem::path out;  // folder for difference pictures; empty: none; so for the following
    std::filesystem::path json; // "-": standard output
    std::filesystem::path junit;
    std::filesystem::path report; // HTML
    std::filesystem::path web_root;
};

// Prints a line for each pair of pictures. The exit code: 0; 1 where a pair breaks a limit, cannot
// be compared, or has no counterpart. Throws StartupError: kIo and kInvalidArgument where nothing
// can be compared, kIo for a file that cannot be written.
[[nodiscard]] int runDiff(const DiffOptions& options);

} // namespace froxel::app
