// What all sessions of one scene share and never change: the scene's summary, the defaults and the
// names that Welcome tells.
#pragma once

#include "core/error.h"
#include "motion/playback.h"
#include "scene/first_view.h"
#include "scene/scene.h"
#include "session/delivery.h"
#include "session/offered_looks.h"
#include "settings/settings.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::session {

// A node of the file, with the instances that it places.
struct PlacingNode {
    uint32_t first_instance = 0; // of scene::Scene::instances; the next node's ends them
    uint32_t node = 0;           // scene::Instance::node
    std::string name;
};

// What is left of a scene when its geometry has gone to the device.
struct SceneSummary {
    std::string name;
    uint64_t file_bytes = 0;     // scene::Scene
    uint32_t triangle_count = 0; // drawn, instances counted each
    uint32_t draw_count = 0;
    uint32_t material_count = 0;
    uint32_t texture_count = 0;
    uint32_t punctual_light_count = 0;
    std::vector<scene::NamedCamera> cameras;
    std::vector<std::string> material_variants;  // their names
    uint32_t material_variant = 0;               // at first; from 1, 0: none
    BoundsD3 bounds_world;                       // empty for an empty scene
    std::shared_ptr<const scene::Motion> motion; // null: it rests
    std::vector<PlacingNode> nodes;              // by first_instance
    std::vector<scene::Extension> extensions;
    std::vector<scene::Warning> warnings;
    uint64_t warnings_left_out = 0;
    bool detail_levels = false; // the device has coarser levels of its meshes
};

[[nodiscard]] SceneSummary summarize(const scene::Scene& scene);

enum class DeviceKind : uint8_t { kCpu, kGpu };

// What a viewer gets before saying anything, and the largest picture that it may ask for.
struct SessionDefaults {
    settings::ViewSettings settings; // but for the camera
    settings::Encoding encoding;
    DeliverySettings delivery;
    std::optional<glm::dvec2> lens_shift; // of the first camera; absent: its own
    // Frames a second below which no active session may fall when another one joins; 0: no matter.
    double min_rate_hz = 0;
    uint64_t max_area_px = uint64_t{4096} * 4096;
};

[[nodiscard]] SessionDefaults defaultsFor(DeviceKind kind);

// The light at a place of the picture (PickLight::at) as a placed one, without an id. Pure, any
// thread. Errors: kInvalidArgument, the end of a sentence about the place.
// `time_s` is the lights' clock.
using LightPicker =
    std::function<Result<settings::PlacedLight>(const settings::ViewSettings& settings,
                                                double time_s,
                                                const std::optional<motion::Playing>& playing,
                                                const glm::dvec2& at)>;

// Of a scene whose lights nobody knows.
[[nodiscard]] Result<settings::PlacedLight> pickNone(const settings::ViewSettings& settings,
                                                     double time_s,
                                                     const std::optional<motion::Playing>& playing,
                                                     const glm::dvec2& at);

struct SessionContext {
    SceneSummary scene;
    SessionDefaults defaults;
    std::string server_version;
    std::string device_name;
    LightPicker pick_light = pickNone;
    scene::FirstView first_view;
    std::vector<OfferedLook> looks = {};
    std::string scene_id{};    // by which viewers ask for it; empty: there is no other
    uint64_t scene_number = 0; // on the device, no other's; 0: the server's first
};

} // namespace froxel::session
