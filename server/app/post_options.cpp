#include "app/post_options.h"

#include "view/ranges.h"

namespace froxel::app {

void addToneMap(CommandBuilder& command, view::ViewSettings& settings) {
    command.number("--exposure", settings.exposure, view::kExposureRange,
                   "Multiplies linear radiance");
    command.name("--tone-map", settings.tone_map, view::kToneMapNames, "After the exposure");
}

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
