#include "session/session_state.h"

#include "core/assert.h"
#include "core/text.h"
#include "scene/first_camera.h"
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

std::string_view nameOf(view::Codec codec) {
    return view::kCodecNames[static_cast<size_t>(codec)];
}

// One overload a command; each changes the state or says why not.
struct Reducer {
    SessionState& state;
    const SessionContext& context;
    TimePoint now;

    using Outcome = std::optional<Rejection>;

    Outcome operator()(const SetCamera& command) const {
        view::Camera camera =
            view::lookAt(command.eye_world, command.target_world, command.up_world);
        const view::Camera& before = state.settings.camera;
        camera.projection = before.projection;
        camera.yfov_rad = before.yfov_rad;
        camera.half_height_m = before.half_height_m;
        camera.near_m = before.near_m;
        camera.lens_shift = command.lens_shift.value_or(before.lens_shift);
        if (command.yfov_rad) {
            camera.projection = view::Projection::kPerspective;
            camera.yfov_rad = *command.yfov_rad;
        } else if (command.half_height_m) {
            camera.projection = view::Projection::kOrthographic;
            camera.half_height_m = *command.half_height_m;
        }
        state.settings.camera = camera;
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
                                          "\" is no camera of this scene; it has " +
                                          (names.empty() ? "none" : printable(names, 400)));
        }
        state.settings.camera = found->camera;
        return {};
    }

    Outcome operator()(const SetRenderer& command) const {
        state.settings.renderer = command.renderer;
        assignIfGiven(state.settings.lighting, command.lighting);
        assignIfGiven(state.settings.shading, command.shading);
        assignIfGiven(state.settings.gbuffer.normal, command.normal);
        assignIfGiven(state.settings.gbuffer.position, command.position);
        return {};
    }

    Outcome operator()(const SetLights& command) const {
        view::Lights& lights = state.settings.lights;
        assignIfGiven(lights.count, command.count);
        assignIfGiven(lights.radius_m, command.radius_m);
        assignIfGiven(lights.intensity, command.intensity);
        assignIfGiven(lights.cutoff, command.cutoff);
        assignIfGiven(lights.cutoff_compensated, command.cutoff_compensated);
        assignIfGiven(state.settings.list_cap, command.list_cap);
        assignIfGiven(lights.seed, command.seed);
        assignIfGiven(lights.animate, command.animate);
        assignIfGiven(lights.speed, command.speed);
        assignIfGiven(lights.ambient, command.ambient);
        assignIfGiven(lights.scene_lights, command.scene_lights);
        assignIfGiven(lights.box, command.box);
        if (command.clear_box) {
            lights.box.reset();
        }
        assignIfGiven(state.settings.light_loop, command.light_loop);
        assignIfGiven(state.settings.count_pairs, command.count_pairs);
        state.light_clock = state.light_clock.withRate(now, lights.speed, lights.animate);
        if (command.time_s) {
            state.light_clock = state.light_clock.withTime(now, *command.time_s);
        }
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
        auto picked =
            context.pick_light(state.settings, state.light_clock.secondsAt(now), command.at);
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
        view::Grid& grid = state.settings.grid;
        assignIfGiven(grid.size, command.size);
        grid.automatic = command.automatic.value_or(grid.automatic && !command.size);
        assignIfGiven(grid.law, command.law);
        return {};
    }

    Outcome operator()(const SetExposure& command) const {
        assignIfGiven(state.settings.exposure, command.exposure);
        assignIfGiven(state.settings.tone_map, command.tone_map);
        return {};
    }

    Outcome operator()(const SetToon& command) const {
        assignIfGiven(state.settings.toon_fragment, command.fragment);
        assignIfGiven(state.settings.toon_compute, command.compute);
        assignIfGiven(state.settings.toon_outline.strength, command.outline_strength);
        assignIfGiven(state.settings.toon_outline.width, command.outline_width);
        return {};
    }

    Outcome operator()(const SetFog& command) const {
        view::Fog& fog = state.settings.fog;
        assignIfGiven(fog.density, command.density);
        assignIfGiven(fog.height_falloff, command.height_falloff);
        assignIfGiven(fog.base_height_m, command.base_height_m);
        assignIfGiven(fog.anisotropy, command.anisotropy);
        assignIfGiven(fog.albedo, command.albedo);
        assignIfGiven(fog.tile_px, command.tile_px);
        assignIfGiven(fog.slice_count, command.slice_count);
        assignIfGiven(fog.half_rate, command.half_rate);
        assignIfGiven(fog.noise, command.noise);
        return {};
    }

    Outcome operator()(const SetDebugView& command) const {
        view::Debug& debug = state.settings.debug;
        assignIfGiven(debug.view, command.view);
        assignIfGiven(debug.scale_max, command.scale_max);
        if (command.freeze && !*command.freeze) {
            debug.grid_camera.reset();
        } else if (command.freeze && !debug.grid_camera) {
            debug.grid_camera = state.settings.camera;
        }
        return {};
    }

    // What is drawn of a picture at most; `field` is the one that asked for more.
    Outcome checkArea(const char* field) const {
        const view::Size& size = state.settings.size;
        const uint64_t across = view::samplesAcross(state.settings.antialiasing);
        const uint64_t area_px = across * across * size.width_px * size.height_px;
        if (area_px <= context.defaults.max_area_px) {
            return {};
        }
        const std::string samples =
            across > 1 ? " with " + numberText(across * across) + " samples a pixel" : "";
        Rejection refused{RejectCode::kCapacity, 0, field,
                          "width x height is " + numberText(size.width_px) + "x" +
                              numberText(size.height_px) + samples +
                              "; this server draws at most " +
                              numberText(context.defaults.max_area_px) + " pixels"};
        refused.blameless = true; // Welcome does not tell it
        return refused;
    }

    Outcome operator()(const SetPost& command) const {
        view::Bloom& bloom = state.settings.bloom;
        assignIfGiven(bloom.kind, command.bloom);
        assignIfGiven(bloom.threshold, command.bloom_threshold);
        assignIfGiven(bloom.knee, command.bloom_knee);
        assignIfGiven(bloom.strength, command.bloom_strength);
        assignIfGiven(bloom.radius, command.bloom_radius);
        assignIfGiven(state.settings.antialiasing, command.antialiasing);
        return command.antialiasing ? checkArea("antialiasing") : Outcome{};
    }

    Outcome operator()(const SetTransparency& command) const {
        assignIfGiven(state.settings.transparency, command.transparency);
        assignIfGiven(state.settings.peel_layers, command.peel_layers);
        return {};
    }

    Outcome operator()(const SetShadows& command) const {
        assignIfGiven(state.settings.shadows.light_count, command.lights);
        assignIfGiven(state.settings.shadows.size_px, command.size_px);
        return {};
    }

    Outcome operator()(const SetSize& command) const {
        state.settings.size = command.size;
        return checkArea("width");
    }

    Outcome operator()(const SetEncoding& command) const {
        if (command.codec && !state.decodable.test(static_cast<size_t>(*command.codec))) {
            return Rejection{RejectCode::kUnsupported, 0, "codec",
                             "codec is " + std::string(nameOf(*command.codec)) +
                                 "; not every viewer's Hello.codecs lists it"};
        }
        assignIfGiven(state.encoding.quality, command.quality);
        assignIfGiven(state.encoding.chroma, command.chroma);
        assignIfGiven(state.encoding.codec, command.codec);
        assignIfGiven(state.encoding.video_kbps, command.video_kbps);
        return {};
    }

    Outcome operator()(const SetDelivery& command) const {
        assignIfGiven(state.delivery.adaptive, command.adaptive);
        assignIfGiven(state.delivery.target_fps, command.target_fps);
        assignIfGiven(state.delivery.refine, command.refine);
        return {};
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

SessionState initialState(const SessionContext& context, TimePoint now) {
    const SessionDefaults& defaults = context.defaults;
    view::ViewSettings settings = defaults.other;
    settings.camera = scene::firstCamera(context.scene.cameras, context.scene.bounds_world);
    settings.camera.lens_shift = defaults.lens_shift.value_or(settings.camera.lens_shift);
    settings.size = defaults.size;
    settings.renderer = defaults.renderer;
    settings.lights.count = defaults.light_count;
    settings.lights.radius_m = defaults.light_radius_m;
    const LightClock clock(now, settings.lights.speed, settings.lights.animate);
    return {settings, defaults.encoding, defaults.delivery, clock, {}};
}

bool setsState(const Command& command) {
    return !holdsOneOf<Hello, Ack, Ping, RequestControl, ReleaseControl, GiveControl, Pause,
                       RequestKeyFrame>(command);
}

CommandResult<SessionState> apply(SessionState state,
                                  const CommandMessage& message,
                                  const SessionContext& context,
                                  TimePoint now) {
    const view::ViewSettings settings_before = state.settings;
    const view::Encoding encoding_before = state.encoding;
    const DeliverySettings delivery_before = state.delivery;
    const double time_before_s = state.light_clock.secondsAt(now);
    if (auto rejection = std::visit(Reducer{state, context, now}, message.body)) {
        rejection->ref_seq = message.stamp.seq;
        return *rejection;
    }
    state.applied = message.stamp;
    if (state.settings != settings_before || state.encoding != encoding_before ||
        state.delivery != delivery_before || state.light_clock.secondsAt(now) != time_before_s) {
        ++state.version;
    }
    return state;
}

} // namespace froxel::session
