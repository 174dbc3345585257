#include "load/storm_script.h"

#include "load/orbit_script.h"

#include <algorithm>
#include <numbers>

namespace froxel::load {
namespace {

constexpr uint32_t kLeastSide = 16;      // pixels
constexpr uint32_t kMostGridSide = 32;   // larger grids would only take memory
constexpr uint32_t kMostGridSlices = 64; // likewise
constexpr uint32_t kKinds = 19;          // of commands
constexpr uint32_t kPlacedIds = 8;       // of lights that come and go

} // namespace

StormScript::StormScript(const v1::Welcome& welcome, uint32_t viewer)
    : start_(welcome.state()),
      cameras_(welcome.scene().cameras().begin(), welcome.scene().cameras().end()),
      random_(viewer) {}

uint32_t StormScript::whole(uint32_t from, uint32_t to) {
    return std::uniform_int_distribution<uint32_t>(from, std::max(from, to))(random_);
}

double StormScript::real(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
}

// From 1, since 0 is UNSPECIFIED everywhere.
template <class Enum>
Enum StormScript::named(Enum last) {
    return static_cast<Enum>(whole(1, static_cast<uint32_t>(last)));
}

void StormScript::fillRenderer(v1::SetRenderer& command) {
    command.set_renderer(named(v1::RENDERER_TOON_COMPUTE));
    command.set_lighting(v1::LIGHTING_STAGE_AUTO);
    command.set_shading(named(v1::SHADING_MODEL_LAMBERT));
    command.mutable_gbuffer()->set_normal(named(v1::NORMAL_ENCODING_SPHEREMAP16));
    command.mutable_gbuffer()->set_position(named(v1::POSITION_SOURCE_FP16));
}

void StormScript::fillLights(v1::SetLights& command) {
    command.set_count(whole(0, 2 * start_.light_count()));
    command.set_radius_m(start_.light_radius_m() * real(0.5, 1.5));
    command.set_intensity(real(0, 4));
    command.set_seed(whole(0, 1000));
    command.set_speed(real(0, 4));
    command.set_animate(whole(0, 3) > 0);
    command.set_light_loop(named(v1::LIGHT_LOOP_ALL_LIGHTS));
    command.set_count_pairs(whole(0, 3) == 0);
}

void StormScript::fillGrid(v1::SetGrid& command) {
    if (whole(0, 1) == 0) {
        command.set_automatic(true);
    } else {
        command.mutable_grid()->set_x(whole(1, kMostGridSide));
        command.mutable_grid()->set_y(whole(1, kMostGridSide));
        command.mutable_grid()->set_z(whole(1, kMostGridSlices));
    }
    command.set_law(named(v1::GRID_LAW_HYPERBOLIC));
}

void StormScript::fillToon(v1::SetToon& command) {
    const uint32_t count = whole(2, 8);
    for (uint32_t index = 0; index < count; ++index) {
        auto& point = *command.mutable_fragment()->add_points();
        point.set_x((index + real(0, 0.9)) / count);
        point.set_y(real(0, 1));
        point.set_slope(real(-2, 2));
    }
}

void StormScript::fillPost(v1::SetPost& command) {
    command.set_bloom(named(v1::BLOOM_KIND_MIP_CHAIN));
    command.set_bloom_threshold(real(0, 4));
    command.set_bloom_radius(real(0.001, 0.02));
    command.set_antialiasing(named(v1::ANTIALIASING_SSAA4));
}

void StormScript::fillPlacedLights(v1::PlacedLights& command) {
    command.set_clear(whole(0, 3) == 0);
    v1::PlacedLight& light = *command.add_lights();
    light.set_id(whole(1, kPlacedIds));
    light.set_kind(named(v1::LIGHT_KIND_SPOT));
    const v1::Box& box = start_.light_box();
    light.mutable_position()->set_x(real(box.min().x(), box.max().x()));
    light.mutable_position()->set_y(real(box.min().y(), box.max().y()));
    light.mutable_position()->set_z(real(box.min().z(), box.max().z()));
    light.mutable_color()->set_x(real(0, 1));
    light.set_radius_m(start_.light_radius_m() * real(0.5, 4));
}

void StormScript::fillFog(v1::Fog& fog) {
    fog.set_density(whole(0, 1) == 0 ? 0 : real(0, 0.3));
    fog.set_height_falloff(real(0, 1));
    fog.set_anisotropy(real(-0.9, 0.9));
    fog.set_tile(whole(8, 64));
    fog.set_slices(whole(8, 64));
    fog.set_half_rate(whole(0, 1) == 0);
    fog.set_noise(whole(0, 1) == 0);
}

void StormScript::fillShadows(v1::SetShadows& command) {
    command.set_lights(whole(0, 2));
    command.set_size(whole(64, 128));
}

void StormScript::fillSize(v1::SetSize& command) {
    command.set_width(whole(kLeastSide, start_.width()));
    command.set_height(whole(kLeastSide, start_.height()));
}

std::optional<Step> StormScript::next() {
    Step step;
    step.at = std::chrono::duration_cast<Clock::duration>(
        Seconds(static_cast<double>(count_) / kStormRate));
    v1::ClientMessage& message = step.message;
    switch (count_++ % kKinds) {
    case 0:
        fillRenderer(*message.mutable_set_renderer());
        break;
    case 1:
        fillLights(*message.mutable_set_lights());
        break;
    case 2:
        fillGrid(*message.mutable_set_grid());
        break;
    case 3:
        message.mutable_set_exposure()->set_exposure(real(0.1, 4));
        message.mutable_set_exposure()->set_tone_map(named(v1::TONE_MAP_CLAMP));
        break;
    case 4:
        fillToon(*message.mutable_set_toon());
        break;
    case 5:
        fillSize(*message.mutable_set_size());
        break;
    case 6:
        message.mutable_set_encoding()->set_quality(whole(1, 100));
        message.mutable_set_encoding()->set_chroma(named(v1::CHROMA_444));
        message.mutable_set_encoding()->set_codec(whole(0, 1) == 0 ? v1::CODEC_JPEG
                                                                   : v1::CODEC_VP9);
        message.mutable_set_encoding()->set_video_kbps(whole(200, 20'000));
        break;
    case 7:
        message.mutable_ping();
        break;
    case 8:
        message.mutable_request_key_frame();
        break;
    case 13:
        // No raw G-buffer: forward renderers have none.
        message.mutable_set_debug_view()->set_view(
            whole(0, 1) == 0 ? v1::DEBUG_VIEW_NONE
                             : static_cast<v1::DebugView>(whole(v1::DEBUG_VIEW_CLUSTER_SLICES,
                                                                v1::DEBUG_VIEW_CLUSTER_WIRES)));
        message.mutable_set_debug_view()->set_freeze(whole(0, 1) == 0);
        break;
    case 14:
        fillPost(*message.mutable_set_post());
        break;
    case 15:
        message.mutable_set_transparency()->set_transparency(named(v1::TRANSPARENCY_PEELED));
        message.mutable_set_transparency()->set_peel_layers(whole(1, 16));
        break;
    case 16:
        fillPlacedLights(*message.mutable_set_placed_lights());
        break;
    case 17:
        fillFog(*message.mutable_set_fog()->mutable_fog());
        break;
    case 18:
        fillShadows(*message.mutable_set_shadows());
        break;
    case 9:
        message.mutable_set_delivery()->set_adaptive(whole(0, 1) == 0);
        message.mutable_set_delivery()->set_target_fps(whole(0, 60));
        message.mutable_set_delivery()->set_refine(named(v1::REFINE_LOSSLESS));
        break;
    case 10:
        if (!cameras_.empty()) {
            const uint32_t last = static_cast<uint32_t>(cameras_.size()) - 1;
            message.mutable_select_scene_camera()->set_name(cameras_[whole(0, last)]);
            break;
        }
        [[fallthrough]];
    default:
        *message.mutable_set_camera() = orbitPose(start_, real(0, 2 * std::numbers::pi));
    }
    return step;
}

} // namespace froxel::load
