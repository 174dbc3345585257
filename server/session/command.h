// What a viewer asked for, after validation: every number is finite and in its range of
// view/ranges.h, every enum is known. Only command_decode makes these from outside bytes.
// Absent fields keep the session's values.
#pragma once

#include "view/settings.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace froxel::session {

struct Hello {
    uint32_t major = 0;
    uint32_t minor = 0;
    std::string client_name;  // untrusted text: escape it before it is logged
    std::string room;         // of isRoomName(), or empty: a session of one's own
    std::string resume_token; // untrusted text, a secret if it is right: never logged; or empty
    view::CodecSet codecs{1}; // what the client decodes; JPEG is in it
    std::string token{};      // untrusted text, a secret if it is right: never logged; or empty
};

struct SetCamera {
    glm::dvec3 eye_world{0};
    glm::dvec3 target_world{0};          // differs from the eye
    glm::dvec3 up_world{0, 1, 0};        // not zero
    std::optional<double> yfov_rad;      // makes the projection perspective
    std::optional<double> half_height_m; // makes it orthographic; never both
    std::optional<glm::dvec2> lens_shift;
};

struct SelectSceneCamera {
    std::string name;
};

struct SetRenderer {
    view::Renderer renderer = view::Renderer::kNaive;
    std::optional<view::LightingStage> lighting;
    std::optional<view::ShadingModel> shading;
    std::optional<view::NormalEncoding> normal;
    std::optional<view::PositionSource> position;
};

struct SetLights {
    std::optional<uint32_t> count;
    std::optional<double> radius_m;
    std::optional<double> intensity;
    std::optional<double> cutoff;
    std::optional<bool> cutoff_compensated = std::nullopt;
    std::optional<uint32_t> list_cap = std::nullopt;
    std::optional<uint32_t> seed;
    std::optional<bool> animate;
    std::optional<double> speed;
    std::optional<double> ambient;
    std::optional<bool> scene_lights;
    std::optional<BoundsD3> box; // min < max on every axis
    bool clear_box = false;      // never together with box
    std::optional<view::LightLoop> light_loop;
    std::optional<bool> count_pairs;
    std::optional<double> time_s; // of the lights' clock
};

struct PlacedLightChange {
    uint32_t id = 0;
    std::optional<view::LightKind> kind;
    std::optional<glm::dvec3> position_world;
    std::optional<glm::dvec3> direction_world; // not zero
    std::optional<glm::vec3> color;
    std::optional<double> intensity;
    std::optional<double> radius_m;
    std::optional<double> inner_cone_deg;
    std::optional<double> outer_cone_deg;
    std::optional<double> width_m;
    std::optional<double> height_m;
    std::optional<double> roll_deg;
    std::optional<view::LightRef> replaces;
};

// Done in the order of the fields.
struct SetPlacedLights {
    bool clear = false;
    std::vector<uint32_t> remove;
    std::vector<PlacedLightChange> lights; // no id twice
};

// A placed light of this id for the seeded or scene light that is nearest there.
struct PickLight {
    uint32_t id = 0;
    glm::dvec2 at{0}; // right and up of the picture's middle, in half pictures
};

struct SetGrid {
    std::optional<view::GridSize> size; // turns automatic off
    std::optional<bool> automatic;      // never true together with size
    std::optional<view::GridLaw> law;
};

struct SetExposure {
    std::optional<double> exposure;
    std::optional<view::ToneMap> tone_map;
};

struct SetToon {
    std::optional<view::ToonRamp> fragment;
    std::optional<view::ToonRamp> compute;
    std::optional<double> outline_strength = std::nullopt;
    std::optional<double> outline_width = std::nullopt;
};

struct SetPost {
    std::optional<view::BloomKind> bloom;
    std::optional<double> bloom_threshold;
    std::optional<double> bloom_knee;
    std::optional<double> bloom_strength;
    std::optional<double> bloom_radius;
    std::optional<view::Antialiasing> antialiasing;
};

struct SetTransparency {
    std::optional<view::Transparency> transparency;
    std::optional<uint32_t> peel_layers;
};

struct SetFog {
    std::optional<double> density;
    std::optional<double> height_falloff;
    std::optional<double> base_height_m;
    std::optional<double> anisotropy;
    std::optional<glm::dvec3> albedo;
    std::optional<uint32_t> tile_px;
    std::optional<uint32_t> slice_count;
    std::optional<bool> half_rate;
    std::optional<bool> noise;
};

struct SetShadows {
    std::optional<uint32_t> lights;
    std::optional<uint32_t> size_px;
};

struct SetDebugView {
    std::optional<view::DebugView> view;
    std::optional<double> scale_max;
    std::optional<bool> freeze;
};

struct SetSize {
    view::Size size;
};

struct SetEncoding {
    std::optional<uint32_t> quality;
    std::optional<view::Chroma> chroma;
    std::optional<view::Codec> codec = std::nullopt;
    std::optional<uint32_t> video_kbps = std::nullopt;
};

struct SetDelivery {
    std::optional<bool> adaptive;
    std::optional<double> target_fps;
    std::optional<view::Refine> refine;
};

// The next frame is to be a key frame.
struct RequestKeyFrame {};

struct Ack {
    uint64_t frame_id = 0;
    uint32_t receive_to_paint_us = 0; // 0: not told
    uint32_t decode_us = 0;           // of which; 0: not told
};

struct Ping {};

struct RequestControl {};

struct ReleaseControl {};

struct GiveControl {
    uint64_t member_id = 0;
};

struct Pause {
    bool paused = false;
};

using Command = std::variant<Hello,
                             SetCamera,
                             SelectSceneCamera,
                             SetRenderer,
                             SetLights,
                             SetPlacedLights,
                             PickLight,
                             SetGrid,
                             SetExposure,
                             SetToon,
                             SetPost,
                             SetFog,
                             SetShadows,
                             SetDebugView,
                             SetTransparency,
                             SetSize,
                             SetEncoding,
                             SetDelivery,
                             RequestKeyFrame,
                             Ack,
                             Ping,
                             RequestControl,
                             ReleaseControl,
                             GiveControl,
                             Pause>;

// Where a command came from; frames echo the newest one that they show.
struct CommandStamp {
    uint64_t seq = 0;            // 0: none yet
    uint64_t client_time_us = 0; // the client's own clock
    uint64_t author = 0;         // whose seq it is, where viewers share a session
    bool operator==(const CommandStamp&) const = default;
};

struct CommandMessage {
    CommandStamp stamp;
    Command body;
};

} // namespace froxel::session
