#include "render/steps/fog_plan.h"

#include "interface/constants.h"
#include "settings/environment.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>

namespace froxel::render {

namespace {

// The last node stands at the last pixel, so that none is beyond the picture.
uint32_t nodesAcross(uint32_t side_px, uint32_t tile_px) {
    return (side_px - 1 + tile_px - 1) / tile_px + 1;
}

uint32_t seedOf(double time_s) {
    const auto bits = std::bit_cast<uint64_t>(time_s);
    return static_cast<uint32_t>((bits ^ bits >> 32U) * 2654435769U);
}

} // namespace

uint32_t fogLightFlags(uint32_t surface_light_flags) {
    return surface_light_flags &
           (io::kLightLocal | io::kLightLists | io::kLightSpots | io::kLightAreas |
            io::kLightShadows | io::kLightEqualRadii | io::kLightSmallScene | io::kLightLong |
            io::kLightDirectional | io::kLightSlicesLinear | io::kLightSlicesHyperbolic);
}

io::Fog makeFog(const settings::ViewSettings& settings, double lit_far_m, double time_s) {
    const settings::Fog& medium = settings.fog;
    // A tile is of the picture's pixels, however many samples they have.
    const uint32_t coarser = medium.half_rate ? 2 : 1;
    const auto density = static_cast<double>(medium.density);
    const double far_m =
        medium.height_falloff > 0 ? lit_far_m : std::min(lit_far_m, kOpaqueDepth / density);
    io::Fog fog{};
    fog.density = medium.density;
    fog.height_falloff = medium.height_falloff;
    fog.eye_height_m = static_cast<float>(settings.camera.eye_world.y - medium.base_height_m);
    fog.anisotropy = medium.anisotropy;
    fog.albedo = medium.albedo;
    fog.far_m = static_cast<float>(far_m);
    fog.ambient =
        0.5F * (settings::kAmbientSky + settings::kAmbientGround) * settings.lights.ambient;
    fog.tile_px = medium.tile_px * coarser * settings::samplesAcross(settings.antialiasing);
    fog.node_count_x = nodesAcross(settings.size.width_px, fog.tile_px);
    fog.node_count_y = nodesAcross(settings.size.height_px, fog.tile_px);
    fog.slice_count = medium.slice_count / coarser;
    fog.seed = seedOf(time_s);
    return fog;
}

uint64_t froxelCount(const io::Fog& fog) {
    return uint64_t{fog.node_count_x} * fog.node_count_y * fog.slice_count;
}

Result<void> checkFroxels(const io::Fog& fog, uint64_t most_texels) {
    const uint64_t count = froxelCount(fog);
    const uint64_t most = std::min(kMostFroxelBytes / kFroxelBytes, most_texels);
    if (count > most) {
        return Error{ErrorCode::kCapacity,
                     fmt::format("fog_tile and fog_slices ask for {}x{}x{} froxels, {} in all; at "
                                 "most {} are allowed; use larger tiles or fewer slices",
                                 fog.node_count_x, fog.node_count_y, fog.slice_count, count, most)};
    }
    return {};
}

} // namespace froxel::render
