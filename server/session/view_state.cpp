#include "session/view_state.h"

#include "session/proto_enums.h"
#include "session/proto_vec.h"

namespace froxel::session {
namespace {

void fill(v1::ToonRamp& out, const view::ToonRamp& ramp) {
    for (uint32_t i = 0; i < ramp.count; ++i) {
        v1::ToonRamp::Point& point = *out.add_points();
        point.set_x(ramp.points[i].x);
        point.set_y(ramp.points[i].y);
        point.set_slope(ramp.points[i].slope);
    }
}

void fillCamera(v1::ViewState& out, const view::Camera& camera) {
    fillVec(*out.mutable_eye(), camera.eye_world);
    fillVec(*out.mutable_target(), camera.target_world());
    fillVec(*out.mutable_up(), camera.world_from_view[1]);
    out.set_fov_deg(glm::degrees(camera.yfov_rad));
    out.set_half_height_m(camera.half_height_m);
    out.set_orthographic(camera.projection == view::Projection::kOrthographic);
    out.mutable_lens_shift()->set_x(camera.lens_shift.x);
    out.mutable_lens_shift()->set_y(camera.lens_shift.y);
}

void fillLights(v1::ViewState& out, const view::Lights& lights, const BoundsD3& scene_bounds) {
    out.set_light_count(lights.count);
    out.set_light_radius_m(lights.radius_m);
    out.set_light_intensity(lights.intensity);
    out.set_light_cutoff(lights.cutoff);
    out.set_light_cutoff_compensated(lights.cutoff_compensated);
    out.set_light_seed(lights.seed);
    out.set_light_animate(lights.animate);
    out.set_light_speed(lights.speed);
    out.set_ambient(lights.ambient);
    out.set_scene_lights(lights.scene_lights);
    if (const BoundsD3 box = lights.box.value_or(scene_bounds); !box.empty()) {
        fillBox(*out.mutable_light_box(), box);
    }
}

void fillPost(v1::ViewState& out, const view::ViewSettings& settings) {
    out.set_bloom(toProto(kBloomKindTable, settings.bloom.kind));
    out.set_bloom_threshold(settings.bloom.threshold);
    out.set_bloom_knee(settings.bloom.knee);
    out.set_bloom_strength(settings.bloom.strength);
    out.set_bloom_radius(settings.bloom.radius);
    out.set_antialiasing(toProto(kAntialiasingTable, settings.antialiasing));
    out.set_shadow_lights(settings.shadows.light_count);
    out.set_shadow_size(settings.shadows.size_px);
}

void fill(v1::Fog& out, const view::Fog& fog) {
    out.set_density(fog.density);
    out.set_height_falloff(fog.height_falloff);
    out.set_base_height(fog.base_height_m);
    out.set_anisotropy(fog.anisotropy);
    fillVec(*out.mutable_albedo(), glm::dvec3(fog.albedo));
    out.set_tile(fog.tile_px);
    out.set_slices(fog.slice_count);
    out.set_half_rate(fog.half_rate);
    out.set_noise(fog.noise);
}

} // namespace

void fillBox(v1::Box& out, const BoundsD3& bounds) {
    fillVec(*out.mutable_min(), bounds.min);
    fillVec(*out.mutable_max(), bounds.max);
}

void fillViewState(v1::ViewState& out, const SessionContext& context, const SessionState& state) {
    const view::ViewSettings& settings = state.settings;
    fillCamera(out, settings.camera);
    fillLights(out, settings.lights, context.scene.bounds_world);
    out.set_renderer(toProto(kRendererTable, settings.renderer));
    out.set_lighting(toProto(kLightingStageTable, settings.lighting));
    out.set_shading(toProto(kShadingModelTable, settings.shading));
    out.mutable_gbuffer()->set_normal(toProto(kNormalEncodingTable, settings.gbuffer.normal));
    out.mutable_gbuffer()->set_position(toProto(kPositionSourceTable, settings.gbuffer.position));
    out.mutable_grid()->set_x(settings.grid.size.x);
    out.mutable_grid()->set_y(settings.grid.size.y);
    out.mutable_grid()->set_z(settings.grid.size.z);
    out.set_grid_automatic(settings.grid.automatic);
    out.set_grid_law(toProto(kGridLawTable, settings.grid.law));
    out.set_light_loop(toProto(kLightLoopTable, settings.light_loop));
    out.set_list_cap(settings.list_cap);
    out.set_count_pairs(settings.count_pairs);
    if (const auto stopped_s = state.light_clock.stoppedAt()) {
        out.set_light_time_s(*stopped_s);
    }
    out.set_debug_view(toProto(kDebugViewTable, settings.debug.view));
    out.set_debug_scale_max(settings.debug.scale_max);
    out.set_debug_frozen(settings.debug.grid_camera.has_value());
    out.set_transparency(toProto(kTransparencyTable, settings.transparency));
    out.set_peel_layers(settings.peel_layers);
    out.set_exposure(settings.exposure);
    out.set_tone_map(toProto(kToneMapTable, settings.tone_map));
    fill(*out.mutable_toon_fragment(), settings.toon_fragment);
    fill(*out.mutable_toon_compute(), settings.toon_compute);
    out.set_outline_strength(settings.toon_outline.strength);
    out.set_outline_width(settings.toon_outline.width);
    fillPost(out, settings);
    fill(*out.mutable_fog(), settings.fog);
    out.set_width(settings.size.width_px);
    out.set_height(settings.size.height_px);
    out.set_quality(state.encoding.quality);
    out.set_chroma(toProto(kChromaTable, state.encoding.chroma));
    out.set_adaptive(state.delivery.adaptive);
    out.set_target_fps(state.delivery.target_fps);
    out.set_refine(toProto(kRefineTable, state.delivery.refine));
    out.set_codec(toProto(kCodecTable, state.encoding.codec));
    out.set_video_kbps(state.encoding.video_kbps);
}

} // namespace froxel::session
