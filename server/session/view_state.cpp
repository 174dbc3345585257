#include "session/view_state.h"

#include "session/proto_enums.h"
#include "session/proto_vec.h"
#include "session/setting_fields.h"

namespace froxel::session {
namespace {

void fill(v1::ToonRamp& out, const settings::ToonRamp& ramp) {
    for (uint32_t i = 0; i < ramp.count; ++i) {
        v1::ToonRamp::Point& point = *out.add_points();
        point.set_x(ramp.points[i].x);
        point.set_y(ramp.points[i].y);
        point.set_slope(ramp.points[i].slope);
    }
}

void fillCamera(v1::ViewState& out, const settings::Camera& camera) {
    fillVec(*out.mutable_eye(), camera.eye_world);
    fillVec(*out.mutable_target(), camera.target_world());
    fillVec(*out.mutable_up(), camera.world_from_view[1]);
    out.set_fov_deg(glm::degrees(camera.yfov_rad));
    out.set_half_height_m(camera.half_height_m);
    out.set_orthographic(camera.projection == settings::Projection::kOrthographic);
    out.mutable_lens_shift()->set_x(camera.lens_shift.x);
    out.mutable_lens_shift()->set_y(camera.lens_shift.y);
}

} // namespace

void fillBox(v1::Box& out, const BoundsD3& bounds) {
    fillVec(*out.mutable_min(), bounds.min);
    fillVec(*out.mutable_max(), bounds.max);
}

void fillViewState(v1::ViewState& out, const SessionContext& context, const SessionState& state) {
    const settings::ViewSettings& settings = state.settings;
    fillCamera(out, settings.camera);
    fillSettings(out, state);
    out.set_compare_split(state.compare_split);
    if (const auto& comparison = state.comparison) {
        out.set_compare(textOf(comparison->right));
        out.set_compare_show(toProto<v1::CompareShow>(kCompareShowNames, comparison->show));
    }
    if (const BoundsD3 box = settings.lights.box.value_or(context.scene.bounds_world);
        !box.empty()) {
        fillBox(*out.mutable_light_box(), box);
    }
    if (const auto stopped_s = state.light_clock.stoppedAt()) {
        out.set_light_time_s(*stopped_s);
    }
    out.set_animation(settings.animation.number);
    if (const auto paused_s = state.playback.pausedAt()) {
        out.set_animation_time_s(*paused_s);
    }
    out.set_material_variant(settings.material_variant);
    if (state.followed) {
        out.set_followed_camera(context.scene.cameras[*state.followed].name);
    }
    out.mutable_grid()->set_x(settings.grid.size.x);
    out.mutable_grid()->set_y(settings.grid.size.y);
    out.mutable_grid()->set_z(settings.grid.size.z);
    out.set_grid_automatic(settings.grid.automatic);
    out.set_debug_frozen(settings.debug.grid_camera.has_value());
    fill(*out.mutable_toon_fragment(), settings.toon_fragment);
    fill(*out.mutable_toon_compute(), settings.toon_compute);
    out.set_width(settings.size.width_px);
    out.set_height(settings.size.height_px);
}

} // namespace froxel::session
