#include "app/view_arguments.h"

#include "app/light_set_file.h"
#include "view/ranges.h"

#include <limits>

namespace froxel::app {

namespace {

constexpr view::Range<uint32_t> kSeedRange{"seed", 0, std::numeric_limits<uint32_t>::max()};

} // namespace

void addShading(CommandBuilder& command, view::ViewSettings& settings) {
    command.name(
        "--lighting", settings.lighting, view::kLightingStageNames,
        "Stage that adds lights up; auto: fragment for forward renderers on a CPU, else compute");
    command.name("--shading", settings.shading, view::kShadingModelNames,
                 "Metallic-roughness, its diffuse part alone, or with Blinn's highlight");
    const auto grid = [&settings](const std::string& text) {
        return parseGridChoice(text, settings.grid);
    };
    command.value("--grid", "auto|XxYxZ", settings.grid, grid, "auto",
                  fmt::format("Clusters across, down and deep, up to {}x{}x{}",
                              view::kGridXRange.max, view::kGridYRange.max, view::kGridZRange.max));
    command.name("--grid-law", settings.grid.law, view::kGridLawNames, "How slices divide depth");
    command.name("--light-loop", settings.light_loop, view::kLightLoopNames,
                 "Lights that a pixel loops over; auto: all where lists cannot pay");
    command.number("--list-cap", settings.list_cap, view::kListCapRange,
                   "Lights that a list keeps at most, those that can add most: faster, darker. 0: "
                   "all");
    command.name("--gbuffer-normal", settings.gbuffer.normal, view::kNormalEncodingNames,
                 "How deferred renderers keep normals");
    command.name("--gbuffer-position", settings.gbuffer.position, view::kPositionSourceNames,
                 "Where deferred lighting takes positions from");
    command.name("--transparency", settings.transparency, view::kTransparencyNames,
                 "How blended surfaces that overlap come together");
    command.number("--peel-layers", settings.peel_layers, view::kPeelLayersRange,
                   "Layers that peeled draws at most");
    command.cli().add_flag("--count-pairs", settings.count_pairs,
                           "Count evaluated and contributing (light, pixel) pairs (slower)");
    command.name("--debug-view", settings.debug.view, view::kDebugViewNames,
                 "Shown instead of the lit picture, or over it");
    command.number("--debug-scale-max", settings.debug.scale_max, view::kDebugScaleRange,
                   "Where its heat map ends; 0: chosen");
}

void addLightDetails(CommandBuilder& command, view::Lights& lights, const char* no_animate) {
    command.number("--light-intensity", lights.intensity, view::kLightIntensityRange,
                   "Scales every seeded light");
    command.number(
        "--light-cutoff", lights.cutoff, view::kLightCutoffRange,
        "A light ends where its irradiance would fall to this: faster, darker. 0: at its "
        "radius");
    command.cli().add_flag("--light-cutoff-compensated", lights.cutoff_compensated,
                           "Lights that end early are brighter by what they lost");
    command.value("--light-box", "BOX", lights.box, parseBox, "the scene's bounds",
                  "Where they move: \"x,y,z;x,y,z\" in metres, least corner first");
    command.number("--light-speed", lights.speed, view::kLightSpeedRange,
                   "Scales the clock that moves them");
    command.number("--seed", lights.seed, kSeedRange, "Picks the lights");
    command.number("--ambient", lights.ambient, view::kAmbientRange, "Scales the ambient term");
    command.cli().add_flag_callback(
        "--no-scene-lights", [&lights] { lights.scene_lights = false; },
        "Leave out the scene's own lights");
    command.cli().add_flag_callback(
        "--no-animate", [&lights] { lights.animate = false; }, no_animate);
}

void addLightSet(CommandBuilder& command, view::PlacedLights& placed, std::filesystem::path& file) {
    const auto parse = [&file](const std::string& text) {
        file = text;
        return readLightSet(file);
    };
    command.value("--light-set", "FILE", placed, parse, "none",
                  "Lights with places of their own, as the page saves them");
}

void addLights(CommandBuilder& command, view::Lights& lights, std::filesystem::path& light_set) {
    command.number("--lights", lights.count, view::kLightCountRange, "Seeded point lights");
    command.number("--light-radius", lights.radius_m, view::kLightRadiusRange,
                   "Where a light reaches exactly 0, in metres");
    addLightDetails(command, lights, "Keep the lights at --time in all --frames");
    addLightSet(command, lights.placed, light_set);
}

} // namespace froxel::app
