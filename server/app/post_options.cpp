#include "app/post_options.h"

#include "view/ranges.h"

namespace froxel::app {

void addToneMap(CommandBuilder& command, view::ViewSettings& settings) {
    command.number("--exposure", settings.exposure, view::kExposureRange,
                   "Multiplies linear radiance");
    command.name("--tone-map", settings.tone_map, view::kToneMapNames, "After the exposure");
}

namespace {

void addFog(CommandBuilder& command, view::Fog& fog) {
    command.number("--fog-density", fog.density, view::kFogDensityRange,
                   "What a medium takes of light in a metre; 0: none");
    command.number("--fog-height-falloff", fog.height_falloff, view::kFogHeightFalloffRange,
                   "A metre above the base height its density falls by this power of e");
    command.number("--fog-base-height", fog.base_height_m, view::kFogBaseHeightRange,
                   "World y up to which its density is whole, in metres");
    command.number("--fog-anisotropy", fog.anisotropy, view::kFogAnisotropyRange,
                   "Whether it scatters light onwards (above 0) or back");
    command.value("--fog-albedo", "R,G,B", fog.albedo, parseAlbedo, "1,1,1",
                  "Share of that light that it scatters; 0 to 1 each");
    command.number("--fog-tile", fog.tile_px, view::kFogTileRange,
                   "Pixels from node to node of the volume that lights are scattered in");
    command.number("--fog-slices", fog.slice_count, view::kFogSlicesRange, "Slices of that volume");
    command.cli().add_flag("--fog-half-rate", fog.half_rate,
                           "Half its resolution on each axis: faster, coarser");
    command.cli().add_flag("--fog-noise", fog.noise,
                           "Sample it at places jittered by time, instead of slices' middles");
}

} // namespace

void addPost(CommandBuilder& command, view::ViewSettings& settings) {
    auto& bloom = settings.bloom;
    command.name("--bloom", bloom.kind, view::kBloomKindNames,
                 "How bright light is spread; mip_chain is the fastest");
    command.number("--bloom-threshold", bloom.threshold, view::kBloomThresholdRange,
                   "Exposed radiance from which light is spread");
    command.number("--bloom-knee", bloom.knee, view::kBloomKneeRange,
                   "Share of the threshold over which spreading sets in");
    command.number("--bloom-strength", bloom.strength, view::kBloomStrengthRange,
                   "Share of bright light that is spread");
    command.number("--bloom-radius", bloom.radius, view::kBloomRadiusRange,
                   "Standard deviation of the spread, as a share of the smaller side");
    command.name("--antialiasing", settings.antialiasing, view::kAntialiasingNames,
                 "A filter over the picture, or four samples a pixel");
    addFog(command, settings.fog);
    auto& shadows = settings.shadows;
    command.number("--shadow-lights", shadows.light_count, view::kShadowLightsRange,
                   "Lights with shadow maps, the most important ones; the others shine through "
                   "walls");
    command.number("--shadow-size", shadows.size_px, view::kShadowSizeRange,
                   "Pixels of a map's side; a point light has six");
    auto& outline = settings.toon_outline;
    command.number("--outline-strength", outline.strength, view::kOutlineStrengthRange,
                   "How dark the toon renderers draw edges");
    command.number("--outline-width", outline.width, view::kOutlineWidthRange,
                   "Of these lines, as a share of the smaller side");
}

} // namespace froxel::app
