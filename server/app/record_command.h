// `froxel record`: a scene to a video file, along a camera path or from one view.
#pragma once

#include "app/render_command.h"

#include <cstdint>
#include <filesystem>

namespace froxel::app {

struct RecordOptions {
    RenderOptions pictures;    // without files of their own
    std::filesystem::path out; // .webm
    double seconds = 10;       // without a path
    uint32_t crf = 20;         // encode::ConstantQuality
};

inline constexpr uint32_t kMaxRecordedFrames = 100'000;

// Draws and encodes frame after frame, as fast as it goes, into FILE.part, which becomes FILE at
// the end: what was there before stays until then. Tells its progress on stdout. Throws
// StartupError.
void runRecord(const RecordOptions& options);

} // namespace froxel::app
