#include "render/frame/frame_uniforms.h"

#include "settings/environment.h"

#include <algorithm>
#include <cmath>

namespace froxel::render {

namespace {

// Beyond any argument of the ramp: an unused segment.
constexpr float kNever = 1e30F;

// Hermite points to cubics in u = x - x0, constant before the first and after the last point.
void fillRamp(const settings::ToonRamp& ramp, io::Frame& frame) {
    for (auto& segment : frame.toon) {
        segment = {kNever, 0, 0, 0, 0};
    }
    frame.toon[0] = {-kNever, 0, 0, 0, ramp.points[0].y};
    for (uint32_t i = 0; i + 1 < ramp.count; ++i) {
        const auto& p = ramp.points[i];
        const auto& q = ramp.points[i + 1];
        const double h = static_cast<double>(q.x) - static_cast<double>(p.x);
        const double rise = (static_cast<double>(q.y) - static_cast<double>(p.y)) / h;
        const double m0 = static_cast<double>(p.slope);
        const double m1 = static_cast<double>(q.slope);
        frame.toon[i + 1] = {p.x, static_cast<float>((m0 + m1 - 2 * rise) / (h * h)),
                             static_cast<float>((3 * rise - 2 * m0 - m1) / h), p.slope, p.y};
    }
    const auto& last = ramp.points[ramp.count - 1];
    frame.toon[ramp.count] = {last.x, 0, 0, 0, last.y};
}

void fillToon(const settings::ViewSettings& settings, io::Frame& frame) {
    const auto bands = static_cast<float>(settings.toon.bands);
    frame.toon_bands = bands;
    frame.toon_band = 1 / std::max(bands, 1.0F);
    frame.toon_brightest = 1 / ((bands - 0.5F) * (bands - 0.5F));
    frame.toon_rim = 1 + settings.toon.rim;
    frame.toon_rim_width = settings.toon.rim_width;
    fillRamp(settings.renderer == settings::Renderer::kToonCompute ? settings.toon_compute
                                                                   : settings.toon_fragment,
             frame);
}

void fillGrid(const cluster::ClusterGrid& grid, io::Frame& frame) {
    frame.tile_width_px = grid.tile_width_px;
    frame.tile_height_px = grid.tile_height_px;
    frame.tile_count_x = grid.size.x;
    frame.tile_count_y = grid.size.y;
    frame.slice_count = grid.size.z;
    frame.slice_first = grid.slice_law.first;
    frame.slice_unit = grid.slice_law.unit;
    frame.slice_scale = grid.slice_law.scale;
    frame.slice_shift = grid.slice_law.shift;
}

} // namespace

ViewProjection
makeProjection(const settings::Camera& camera, const settings::Size& size, double far_m) {
    const double aspect = settings::aspectOf(size);
    ViewProjection p;
    const double half = camera.projection == settings::Projection::kPerspective
                            ? std::tan(camera.yfov_rad * 0.5)
                            : camera.half_height_m;
    p.clip_scale = {1.0 / (half * aspect), -1.0 / half}; // Vulkan's clip space has y down
    p.clip_offset = {-camera.lens_shift.x, camera.lens_shift.y};
    p.far_m = std::max(far_m, camera.near_m + 1e-3);
    return p;
}

io::Frame makeFrameUniforms(const settings::ViewSettings& settings,
                            const ViewProjection& projection,
                            const cluster::ClusterGrid* grid,
                            uint32_t light_count,
                            uint32_t directional_count) {
    const auto& camera = settings.camera;
    io::Frame frame{};
    frame.camera.clip_scale = projection.clip_scale;
    frame.camera.clip_offset = projection.clip_offset;
    const double near = camera.near_m;
    if (camera.projection == settings::Projection::kPerspective) {
        // Reversed-Z, infinite far: depth = near / distance.
        frame.camera.clip_z = {near, 0};
        frame.camera.clip_w = {0, -1};
        frame.camera.distance_num = {near, 0};
        frame.camera.distance_den = {0, 1};
        frame.camera.ray_spread = {0, 1};
    } else {
        const double range = projection.far_m - near;
        frame.camera.clip_z = {projection.far_m / range, 1.0 / range};
        frame.camera.clip_w = {1, 0};
        frame.camera.distance_num = {projection.far_m, -range};
        frame.camera.distance_den = {1, 0};
        frame.camera.ray_spread = {1, 0};
        frame.camera.orthographic = 1;
    }
    frame.camera.ray_scale = {2.0 / (settings.size.width_px * projection.clip_scale.x),
                              2.0 / (settings.size.height_px * projection.clip_scale.y)};
    frame.camera.ray_offset = (glm::dvec2(-1.0) - projection.clip_offset) / projection.clip_scale;
    frame.camera.geometry_error_px = settings.geometry_error_px;
    frame.camera.width_px = settings.size.width_px;
    frame.camera.height_px = settings.size.height_px;
    frame.tile_width_px = settings.size.width_px;
    frame.tile_height_px = settings.size.height_px;
    frame.tile_count_x = frame.tile_count_y = frame.slice_count = 1;
    if (grid != nullptr) {
        fillGrid(*grid, frame);
    }
    frame.light_count = light_count;
    frame.directional_count = directional_count;
    frame.up_view = glm::vec3(glm::transpose(camera.world_from_view)[1]);
    frame.exposure = settings.exposure;
    frame.ambient_sky = settings::kAmbientSky * settings.lights.ambient;
    frame.ambient_ground = settings::kAmbientGround * settings.lights.ambient;
    frame.background = settings.background.color;
    frame.background_gradient = settings.background.gradient;
    const auto& outline = settings.toon_outline;
    const auto side_px =
        static_cast<float>(std::min(settings.size.width_px, settings.size.height_px));
    frame.outline_strength = outline.strength;
    frame.outline_reach_px = std::max(1.0F, outline.width * side_px);
    fillToon(settings, frame);
    return frame;
}

} // namespace froxel::render
