// What a viewer asked for, after validation: every number is finite and in its range, every enum is
// known. Only command_decode makes these from outside bytes.
// Absent fields keep the session's values.
#pragma once

#include "session/comparison.h"
#include "session/settings.h"
#include "settings/settings.h"

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
    settings::CodecSet codecs = settings::commonCodecs(); // what the client decodes
    std::string token{}; // untrusted text, a secret if it is right: never logged; or empty
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

struct SelectScene {
    std::string id; // untrusted text
};

// Settings of the table; every command that gives nothing else.
struct SetSettings {
    SettingChanges changes;
};

// These give what no row of the table holds, besides settings.
struct SetLights : SetSettings {
    std::optional<BoundsD3> box = std::nullopt;  // min < max on every axis
    bool clear_box = false;                      // never together with box
    std::optional<double> time_s = std::nullopt; // of the lights' clock
};

struct SetAnimation : SetSettings {
    std::optional<uint32_t> number = std::nullopt; // as settings::Animation has it
    std::optional<double> time_s = std::nullopt;   // of the animation
};

struct SetMaterialVariant {
    uint32_t number = 0; // as settings::ViewSettings has it
};

struct PlacedLightChange {
    uint32_t id = 0;
    std::optional<settings::LightKind> kind;
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
    std::optional<settings::LightRef> replaces;
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

struct SetGrid : SetSettings {
    std::optional<settings::GridSize> size = std::nullopt; // turns automatic off
    std::optional<bool> automatic = std::nullopt;          // never true together with size
};

struct SetToon : SetSettings {
    std::optional<settings::ToonRamp> fragment = std::nullopt;
    std::optional<settings::ToonRamp> compute = std::nullopt;
};

struct SetDebugView : SetSettings {
    std::optional<bool> freeze = std::nullopt;
};

struct SetCompare {
    std::optional<SettingChanges> right; // empty: nothing is compared
    std::optional<double> split;
    std::optional<CompareShow> show;
};

struct SetSize {
    settings::Size size;
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

struct RequestDepth {
    bool wanted = false;
};

using Command = std::variant<Hello,
                             SetCamera,
                             SelectSceneCamera,
                             SelectScene,
                             SetSettings,
                             SetLights,
                             SetAnimation,
                             SetMaterialVariant,
                             SetPlacedLights,
                             PickLight,
                             SetGrid,
                             SetToon,
                             SetDebugView,
                             SetCompare,
                             SetSize,
                             RequestKeyFrame,
                             Ack,
                             Ping,
                             RequestControl,
                             ReleaseControl,
                             GiveControl,
                             Pause,
                             RequestDepth>;

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
