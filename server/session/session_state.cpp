#include "session/session_state.h"

#include "core/assert.h"
#include "core/text.h"
#include "motion/posed_scene.h"
#include "scene/motion.h"
#include "scene/name_list.h"
#include "session/placed_lights.h"

#include <algorithm>
#include <optional>

namespace froxel::session {
namespace {

template <class Target, class Value>
void assignIfGiven(Target& target, const std::optional<Value>& value) {
    if (value) {
        target = static_cast<Target>(*value);
    }
}

// A camera of the scene that its animations move.
std::optional<uint32_t> followedOf(const SessionContext& context, size_t camera) {
    const auto index = static_cast<uint32_t>(camera);
    const bool moves = context.scene.motion && motion::movesCamera(*context.scene.motion, index);
    return moves ? std::optional(index) : std::nullopt;
}

// One overload a command; each changes the state or says why not.
struct Reducer {
    SessionState& state;
    const SessionContext& context;
    TimePoint now;

    using Outcome = std::optional<Rejection>;

    Outcome operator()(const SetCamera& command) const {
        settings::Camera camera =
            settings::lookAt(command.eye_world, command.target_world, command.up_world);
        const settings::Camera& before = state.settings.camera;
        camera.projection = before.projection;
        camera.yfov_rad = before.yfov_rad;
        camera.half_height_m = before.half_height_m;
        camera.near_m = before.near_m;
        camera.lens_shift = command.lens_shift.value_or(before.lens_shift);
        if (command.yfov_rad) {
            camera.projection = settings::Projection::kPerspective;
            camera.yfov_rad = *command.yfov_rad;
        } else if (command.half_height_m) {
            camera.projection = settings::Projection::kOrthographic;
            camera.half_height_m = *command.half_height_m;
        }
        state.settings.camera = camera;
        state.followed.reset();
        return {};
    }

    Outcome operator()(const SelectSceneCamera& command) const {
        const auto& cameras = context.scene.cameras;
        const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const auto& camera) {
            return camera.name == command.name;
        });
        if (found == cameras.end()) {
            std::string names;
            for (const auto& camera : cameras) {
                names += (names.empty() ? "" : ", ") + printable(camera.name);
            }
            return outOfRange("name", "\"" + printable(command.name) +
                                          "\" is not a camera of this scene; it has " +
                                          (names.empty() ? "none" : printable(names, 400)));
        }
        state.settings.camera = found->camera;
        state.followed = followedOf(context, static_cast<size_t>(found - cameras.begin()));
        return {};
    }

    Outcome set(const SettingChanges& changes) const {
        for (const SettingChange& change : changes) {
            change.setting->set(state, change.value);
        }
        if (const auto* codec = givenIn(changes, "codec");
            codec != nullptr && !state.decodable.test(std::get<settings::Choice>(*codec).index)) {
            return Rejection{RejectCode::kUnsupported, 0, "codec",
                             "codec is " + std::string(settings::rowOf(state.encoding.codec).name) +
                                 "; not every viewer's Hello.codecs lists it"};
        }
        return givenIn(changes, "antialiasing") != nullptr ? checkArea("antialiasing") : Outcome{};
    }

    Outcome operator()(const SetSettings& command) const { return set(command.changes); }

    Outcome operator()(const SetLights& command) const {
        settings::Lights& lights = state.settings.lights;
        assignIfGiven(lights.box, command.box);
        if (command.clear_box) {
            lights.box.reset();
        }
        Outcome outcome = set(command.changes);
        state.light_clock = state.light_clock.withRate(now, lights.speed, lights.animate);
        if (command.time_s) {
            state.light_clock = state.light_clock.withTime(now, *command.time_s);
        }
        return outcome;
    }

    Outcome operator()(const SetAnimation& command) const {
        static const std::vector<scene::Clip> kNoClips;
        const auto& clips = context.scene.motion ? context.scene.motion->clips : kNoClips;
        settings::Animation& animation = state.settings.animation;
        assignIfGiven(animation.number, command.number);
        if (animation.number > clips.size()) {
            return outOfRange("animation", "is " + numberText(animation.number) +
                                               "; this scene has " +
                                               scene::numberedList(namesOf(clips)));
        }
        Outcome outcome = set(command.changes);
        state.playback.follow(animation, SessionState::secondsOf(now));
        return command.time_s && !outcome ? seek(*command.time_s) : outcome;
    }

    // Beyond its end the animation goes on as it repeats.
    Outcome seek(double time_s) const {
        const uint32_t number = state.settings.animation.number;
        if (number == 0) {
            return outOfRange("animation_time",
                              "is " + numberText(time_s) + "; no animation is selected");
        }
        state.playback.seek(time_s, SessionState::secondsOf(now));
        return {};
    }

    Outcome operator()(const SetMaterialVariant& command) const {
        const auto& names = context.scene.material_variants;
        if (command.number > names.size()) {
            return outOfRange("material_variant", "is " + numberText(command.number) +
                                                      "; this scene has " +
                                                      scene::numberedList(names));
        }
        state.settings.material_variant = command.number;
        return {};
    }

    Outcome operator()(const SetPlacedLights& command) const {
        const auto placed = changed(state.settings.lights.placed, command);
        if (!placed) {
            return placed.error();
        }
        state.settings.lights.placed = *placed;
        return {};
    }

    Outcome operator()(const PickLight& command) const {
        settings::ViewSettings seen = state.settings;
        seen.camera = state.cameraAt(now);
        auto picked =
            context.pick_light(seen, state.light_clock.secondsAt(now),
                               state.playback.at(SessionState::secondsOf(now)), command.at);
        if (!picked) {
            Rejection miss = outOfRange("x", picked.error().message);
            miss.blameless = true;
            return miss;
        }
        picked->id = command.id;
        const auto placed = withPicked(state.settings.lights.placed, *picked);
        if (!placed) {
            return placed.error();
        }
        state.settings.lights.placed = *placed;
        return {};
    }

    Outcome operator()(const SetGrid& command) const {
        settings::Grid& grid = state.settings.grid;
        assignIfGiven(grid.size, command.size);
        grid.automatic = command.automatic.value_or(grid.automatic && !command.size);
        return set(command.changes);
    }

    Outcome operator()(const SetToon& command) const {
        assignIfGiven(state.settings.toon_fragment, command.fragment);
        assignIfGiven(state.settings.toon_compute, command.compute);
        return set(command.changes);
    }

    Outcome operator()(const SetDebugView& command) const {
        settings::Debug& debug = state.settings.debug;
        if (command.freeze && !*command.freeze) {
            debug.grid_camera.reset();
        } else if (command.freeze && !debug.grid_camera) {
            debug.grid_camera = state.cameraAt(now);
        }
        return set(command.changes);
    }

    Outcome operator()(const SetCompare& command) const {
        assignIfGiven(state.compare_split, command.split);
        Comparison comparison = state.comparison.value_or(Comparison{});
        assignIfGiven(comparison.right, command.right);
        assignIfGiven(comparison.show, command.show);
        if (comparison.right.empty() && command.show && !command.right) {
            return outOfRange("show", "is given while nothing is compared; give right, too");
        }
        state.comparison.reset();
        if (!comparison.right.empty()) {
            state.comparison = std::move(comparison);
        }
        return checkArea("right");
    }

    [[nodiscard]] static uint64_t samplesOf(const SessionState& side) {
        const uint64_t across = settings::samplesAcross(side.settings.antialiasing);
        return across * across;
    }

    // What is drawn of a picture at most; `field` is the one that asked for more.
    Outcome checkArea(const char* field) const {
        const settings::Size& size = state.settings.size;
        const uint64_t of_right = state.comparison ? samplesOf(rightOf(state)) : 0;
        const uint64_t sample_count = samplesOf(state) + of_right;
        const uint64_t area_px = sample_count * size.width_px * size.height_px;
        if (area_px <= context.defaults.max_area_px) {
            return {};
        }
        const std::string samples =
            sample_count > 1 ? " with " + numberText(sample_count) + " samples a pixel" +
                                   (of_right > 0 ? ", of both sides of a comparison" : "")
                             : "";
        Rejection refused{RejectCode::kCapacity, 0, field,
                          "width x height is " + numberText(size.width_px) + "x" +
                              numberText(size.height_px) + samples +
                              "; this server draws at most " +
                              numberText(context.defaults.max_area_px) + " pixels"};
        refused.too_large_by =
            static_cast<double>(area_px) / static_cast<double>(context.defaults.max_area_px);
        refused.blameless = true; // Welcome does not tell it
        return refused;
    }

    Outcome operator()(const SetSize& command) const {
        settings::ViewSettings& settings = state.settings;
        // Who has not moved yet sees all of the scene, whatever the window's shape.
        if (settings.camera == openingCamera(context, settings.size)) {
            settings.camera = openingCamera(context, command.size);
        }
        settings.size = command.size;
        return checkArea("width");
    }

    template <class Other>
    Outcome operator()(const Other& /*command*/) const {
        FROXEL_ASSERT(false, "a command that sets no state reached the reducer");
        return {};
    }
};

template <class... Kinds>
bool holdsOneOf(const Command& command) {
    return (std::holds_alternative<Kinds>(command) || ...);
}

} // namespace

settings::Camera openingCamera(const SessionContext& context, const settings::Size& size) {
    settings::Camera camera = context.first_view.cameraFor(size);
    camera.lens_shift = context.defaults.lens_shift.value_or(camera.lens_shift);
    return camera;
}

settings::Camera SessionState::cameraAt(TimePoint now) const {
    const auto playing = followed ? playback.at(secondsOf(now)) : std::nullopt;
    return playing ? motion::cameraAt(*playback.motion(), *followed, *playing, settings.camera)
                   : settings.camera;
}

SessionState initialState(const SessionContext& context, TimePoint now) {
    const SessionDefaults& defaults = context.defaults;
    settings::ViewSettings settings = defaults.settings;
    settings.camera = openingCamera(context, settings.size);
    const LightClock clock(now, settings.lights.speed, settings.lights.animate);
    const auto& motion = context.scene.motion;
    settings.animation.number = motion ? motion::usualAnimation(*motion) : 0;
    settings.material_variant = context.scene.material_variant;
    SessionState state{settings, defaults.encoding, defaults.delivery, clock, {}};
    state.playback = {motion, settings.animation, SessionState::secondsOf(now)};
    if (const auto camera = context.first_view.scene_camera) {
        state.followed = followedOf(context, *camera);
    }
    return state;
}

bool setsState(const Command& command) {
    return !holdsOneOf<Hello, Ack, Ping, RequestControl, ReleaseControl, GiveControl, Pause,
                       RequestDepth, RequestKeyFrame, SelectScene>(command);
}

CommandResult<SessionState> apply(SessionState state,
                                  const CommandMessage& message,
                                  const SessionContext& context,
                                  TimePoint now) {
    const settings::ViewSettings settings_before = state.settings;
    const settings::Encoding encoding_before = state.encoding;
    const DeliverySettings delivery_before = state.delivery;
    const double time_before_s = state.light_clock.secondsAt(now);
    const motion::Playback playback_before = state.playback;
    const auto followed_before = state.followed;
    const auto comparison_before = state.comparison;
    if (auto rejection = std::visit(Reducer{state, context, now}, message.body)) {
        rejection->ref_seq = message.stamp.seq;
        return *rejection;
    }
    state.applied = message.stamp;
    if (state.settings != settings_before || state.encoding != encoding_before ||
        state.delivery != delivery_before || state.light_clock.secondsAt(now) != time_before_s ||
        !(state.playback == playback_before) || state.followed != followed_before ||
        state.comparison != comparison_before) {
        ++state.version;
    }
    return state;
}

} // namespace froxel::session
