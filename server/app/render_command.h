// `froxel render`: a scene to a picture, or to timings along the lights' animation.
#pragma once

#include "app/scene_source.h"
#include "app/setting_options.h"
#include "app/value_parsers.h"
#include "gpu/device_options.h"
#include "session/settings.h"
#include "settings/settings.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct RenderOptions {
    std::string scene = "builtin";
    SceneChoices choices;
    bake::Sandbox sandbox = bake::Sandbox::kBest;
    std::filesystem::path environment_file; // of light from around; empty: none
    gpu::DeviceOptions device;
    settings::ViewSettings settings; // but for the camera, which `camera` chooses
    GivenSettings given;             // of them; what was not goes by the scene, as firstLook()
    ChosenLook look;
    std::filesystem::path light_set; // that settings.lights.placed was read from; empty: none
    CameraChoice camera;
    std::optional<glm::dvec2> lens_shift;    // of whichever camera it is
    std::optional<CameraChoice> grid_camera; // of the debug view cluster_wires
    double time_s = 0;                       // the lights' clock of the first frame
    settings::Encoding encoding;
    // Empty: no picture; else .png, .jpg, .exr or .pfm, of the last frame; or, of a camera path, a
    // folder, whose name ends with a slash, for all of them.
    std::filesystem::path out;
    uint32_t frame_count = 1; // frame k is drawn k / fps later, by the lights' clock too
    double fps = 30;
    // That the camera follows, as --path has it, for as many frames as it has; empty: it rests.
    std::string path;
    double path_seconds = 10; // of a built-in path
    // Drawn at time_s before the first frame and not counted: the first frame of a run compiles
    // pipelines and sizes the light lists.
    uint32_t warmup_count = 3;
    bool keep_surfaces = false;    // from frame to frame, as serve does
    std::filesystem::path timings; // empty: none; else timings_report.h's JSON
    // What the left and the right side have otherwise; empty: one picture.
    std::vector<session::SettingChanges> compare;
    double compare_split = 0.5;     // where the divider of their picture is
    std::optional<double> max_flip; // of the two sides; none: any

    [[nodiscard]] bool writesFolder() const { return !out.empty() && out.filename().empty(); }
};

// Frames are drawn one after another, each collected before the next is submitted. The exit code:
// 0; 1 where the sides of a comparison are farther apart than `max_flip`. Throws StartupError.
[[nodiscard]] int runRender(const RenderOptions& options);

} // namespace froxel::app
