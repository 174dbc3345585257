// Every setting is in reports: two runs that differ in one must not read the same.
#include "app/timings_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <vector>

namespace froxel::app {
namespace {

using view::ViewSettings;
using Change = std::function<void(ViewSettings&)>;

view::PlacedLights onePlaced() {
    view::PlacedLight light;
    light.id = 1;
    return view::PlacedLights({light});
}

// What of each struct is told by changing one field of it. A new field does not compile here until
// it has a name, and then asks for a change of its own.
std::vector<Change> changesOf(ViewSettings s) {
    [[maybe_unused]] const auto& [camera, size, renderer, lighting, shading, gbuffer, grid,
                                  light_loop, list_cap, count_pairs, debug, transparency,
                                  peel_layers, lights, shadows, exposure, tone_map, toon_fragment,
                                  toon_compute, toon_outline, bloom, fog, antialiasing] = s;
    [[maybe_unused]] const auto& [normal, position] = gbuffer;
    [[maybe_unused]] const auto& [automatic, grid_size, law] = grid;
    [[maybe_unused]] const auto& [debug_view, scale_max, grid_camera] = debug;
    [[maybe_unused]] const auto& [count, radius, intensity, cutoff, compensated, seed, animate,
                                  speed, box, ambient, scene_lights, placed] = lights;
    [[maybe_unused]] const auto& [shadow_lights, shadow_size] = shadows;
    [[maybe_unused]] const auto& [strength, width] = toon_outline;
    [[maybe_unused]] const auto& [kind, threshold, knee, bloom_strength, bloom_radius] = bloom;
    [[maybe_unused]] const auto& [density, falloff, base, anisotropy, albedo, tile, slices,
                                  half_rate, noise] = fog;
    return {
        [](auto& v) { v.camera.eye_world.x += 1; },
        [](auto& v) { v.size.width_px += 1; },
        [](auto& v) { v.size.height_px += 1; },
        [](auto& v) { v.renderer = view::Renderer::kNaive; },
        [](auto& v) { v.lighting = view::LightingStage::kFragment; },
        [](auto& v) { v.shading = view::ShadingModel::kLambert; },
        [](auto& v) { v.gbuffer.normal = view::NormalEncoding::kOct8; },
        [](auto& v) { v.gbuffer.position = view::PositionSource::kFp16; },
        [](auto& v) { v.grid.automatic = false; },
        [](auto& v) {
            v.grid.automatic = false;
            v.grid.size.x += 1;
        },
        [](auto& v) { v.grid.law = view::GridLaw::kHyperbolic; },
        [](auto& v) { v.light_loop = view::LightLoop::kLists; },
        [](auto& v) { v.list_cap = 16; },
        [](auto& v) { v.count_pairs = true; },
        [](auto& v) { v.debug.view = view::DebugView::kNormal; },
        [](auto& v) { v.debug.scale_max = 12; },
        [](auto& v) { v.debug.grid_camera = view::Camera(); },
        [](auto& v) { v.transparency = view::Transparency::kWeighted; },
        [](auto& v) {
            v.transparency = view::Transparency::kPeeled;
            v.peel_layers += 1;
        },
        [](auto& v) { v.lights.count += 1; },
        [](auto& v) { v.lights.radius_m += 1; },
        [](auto& v) { v.lights.intensity += 1; },
        [](auto& v) { v.lights.cutoff += 1; },
        [](auto& v) { v.lights.cutoff_compensated = true; },
        [](auto& v) { v.lights.seed += 1; },
        [](auto& v) { v.lights.animate = false; },
        [](auto& v) { v.lights.speed += 1; },
        [](auto& v) {
            v.lights.box = BoundsD3{{0, 0, 0}, {1, 1, 1}};
        },
        [](auto& v) { v.lights.ambient += 1; },
        [](auto& v) { v.lights.scene_lights = false; },
        [](auto& v) { v.lights.placed = onePlaced(); },
        [](auto& v) { v.shadows.light_count = 1; },
        [](auto& v) { v.shadows = {.light_count = 1, .size_px = 64}; },
        [](auto& v) { v.exposure += 1; },
        [](auto& v) { v.tone_map = view::ToneMap::kClamp; },
        [](auto& v) { v.toon_fragment.points[1].y = 0.5F; },
        [](auto& v) { v.toon_compute.points[1].y = 0.5F; },
        [](auto& v) { v.toon_outline.strength = 1; },
        [](auto& v) { v.toon_outline = {.strength = 1, .width = 0.01F}; },
        [](auto& v) { v.bloom.kind = view::BloomKind::kSeparable; },
        [](auto& v) { v.bloom = {.kind = view::BloomKind::kSeparable, .threshold = 2}; },
        [](auto& v) { v.bloom = {.kind = view::BloomKind::kSeparable, .knee = 0}; },
        [](auto& v) { v.bloom = {.kind = view::BloomKind::kSeparable, .strength = 1}; },
        [](auto& v) { v.bloom = {.kind = view::BloomKind::kSeparable, .radius = 0.05F}; },
        [](auto& v) { v.fog.density = 1; },
        [](auto& v) { v.fog = {.density = 1, .height_falloff = 1}; },
        [](auto& v) { v.fog = {.density = 1, .base_height_m = 1}; },
        [](auto& v) { v.fog = {.density = 1, .anisotropy = 0.5F}; },
        [](auto& v) { v.fog = {.density = 1, .albedo = glm::vec3(0)}; },
        [](auto& v) { v.fog = {.density = 1, .tile_px = 8}; },
        [](auto& v) { v.fog = {.density = 1, .slice_count = 32}; },
        [](auto& v) { v.fog = {.density = 1, .half_rate = true}; },
        [](auto& v) { v.fog = {.density = 1, .noise = true}; },
        [](auto& v) { v.antialiasing = view::Antialiasing::kFxaa; },
    };
}

TEST(SettingsReport, EverySetting_ReadsDifferentlyThanAllOthers) {
    std::vector<std::string> told = {settingsReport({}).dump()};
    for (const Change& change : changesOf({})) {
        ViewSettings settings;
        change(settings);
        const std::string report = settingsReport(settings).dump();
        EXPECT_EQ(std::count(told.begin(), told.end(), report), 0)
            << "change " << told.size() << " is not told: " << report;
        told.push_back(report);
    }
}

} // namespace
} // namespace froxel::app
