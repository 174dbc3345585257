// The table of settings: a row for each number, switch, name and colour that a viewer may set.
// Options, commands, messages, reports and documents take everything from here; the protocol's
// fields name their row by the option (setting). By hand are the camera, sizes, grid sizes,
// lights' box, placed lights, the animation's number and ramps.
#pragma once

#include "settings/setting.h"
#include "settings/settings.h"

#include <limits>

namespace froxel::settings {

inline constexpr std::array kSettingRows = {
    row<&ViewSettings::renderer>(Names{"renderer", kRendererNames}, "renderer", {"How to draw"}),
    row<&ViewSettings::lighting>(
        Names{"lighting", kLightingStageNames},
        "lighting",
        {"Stage that adds lights up; auto: fragment for forward renderers on a CPU, else compute"}),
    row<&ViewSettings::shading>(
        Names{"shading", kShadingModelNames},
        "shading",
        {"Metallic-roughness, its diffuse part alone, or with Blinn's highlight", "",
         "lambert: a third of the time a light"}),
    row<&ViewSettings::gbuffer, &GbufferLayout::normal>(
        Names{"gbuffer_normal", kNormalEncodingNames},
        "gbuffer.normal",
        {"How deferred renderers keep normals", "", "fewer bits: less memory to pass, more error"}),
    row<&ViewSettings::gbuffer, &GbufferLayout::position>(
        Names{"gbuffer_position", kPositionSourceNames},
        "gbuffer.position",
        {"Where deferred lighting takes positions from", "", "a stored one: more memory to pass"}),
    row<&ViewSettings::grid, &Grid::law>(
        Names{"grid_law", kGridLawNames}, "grid_law", {"How slices divide depth"}),
    row<&ViewSettings::light_loop>(
        Names{"light_loop", kLightLoopNames},
        "light_loop",
        {"Lights that a pixel loops over; auto: all where lists cannot pay"}),
    row<&ViewSettings::list_cap>(
        Range<uint32_t>{"list_cap", 0, 65'535},
        "list_cap",
        {"Lights that a list keeps at most, those that can add most. 0: all", "",
         "faster, darker; lists are made on the host"}),
    row<&ViewSettings::transparency>(
        Names{"transparency", kTransparencyNames},
        "transparency",
        {"How blended surfaces that overlap come together", "",
         "weighted: as sorted; peeled: two passes over the glass a layer"}),
    row<&ViewSettings::peel_layers>(
        kPeelLayersRange,
        "peel_layers",
        {"Layers that peeled draws at most", "", "each: what is visible of it"}),
    row<&ViewSettings::count_pairs>(
        Switch{"count_pairs"},
        "count_pairs",
        {"Count evaluated and contributing (light, pixel) pairs", "", "a pass over all pairs"}),
    row<&ViewSettings::debug, &Debug::view>(Names{"debug_view", kDebugViewNames},
                                            "debug_view",
                                            {"Shown instead of the lit picture, or over it", "",
                                             "no lighting, one pass; lines: one pass more"}),
    row<&ViewSettings::debug, &Debug::scale_max>(Range<double>{"debug_scale_max", 0, 1e6},
                                                 "debug_scale_max",
                                                 {"Where its heat map ends; 0: chosen"}),

    row<&ViewSettings::lights, &Lights::count>(
        kLightCountRange,
        "lights.count",
        {"Seeded point lights", "", "each: what its radius reaches"}),
    row<&ViewSettings::lights, &Lights::radius_m>(
        kLightRadiusRange,
        "lights.radius_m",
        {"Where a light reaches exactly 0", "m", "grows with its square and more"}),
    row<&ViewSettings::lights, &Lights::intensity>(
        kLightIntensityRange, "lights.intensity", {"Scales every seeded light"}),
    row<&ViewSettings::lights, &Lights::cutoff>(
        Range<double>{"light_cutoff", 0, 1'000},
        "lights.cutoff",
        {"A light ends where its irradiance would fall to this. 0: at its radius", "",
         "faster, darker"}),
    row<&ViewSettings::lights, &Lights::cutoff_compensated>(
        Switch{"light_cutoff_compensated"},
        "lights.cutoff_compensated",
        {"Lights that end early are brighter by what they lost", "", "nothing"}),
    row<&ViewSettings::lights, &Lights::seed>(
        Range<uint32_t>{"seed", 0, std::numeric_limits<uint32_t>::max()},
        "lights.seed",
        {"Picks the lights"}),
    row<&ViewSettings::lights, &Lights::animate>(
        Switch{"animate"}, "lights.animate", {"Motion of the lights"}),
    row<&ViewSettings::lights, &Lights::speed>(
        Range<double>{"light_speed", 0, 100}, "lights.speed", {"Scales the clock that moves them"}),
    row<&ViewSettings::lights, &Lights::ambient>(
        Range<double>{"ambient", 0, 1'000},
        "lights.ambient",
        {"Scales the ambient term, where the environment is off"}),
    row<&ViewSettings::lights, &Lights::scene_lights>(
        Switch{"scene_lights"}, "lights.scene_lights", {"The scene's own lights"}),

    row<&ViewSettings::animation, &Animation::playing>(
        Switch{"animation_playing"},
        "animation.playing",
        {"The scene's animation goes on", "", "what moves is drawn anew"}),
    row<&ViewSettings::animation, &Animation::speed>(
        Range<double>{"animation_speed", -100, 100},
        "animation.speed",
        {"Scales the clock of the scene's animation; below 0: backwards"}),
    row<&ViewSettings::animation, &Animation::repeat>(
        Names{"animation_repeat", kRepeatNames}, "animation.repeat", {"What it does at its ends"}),
    row<&ViewSettings::animation, &Animation::fade_s>(
        Range<double>{"animation_fade", 0, 10},
        "animation.fade_s",
        {"That going over to another animation takes", "s", "meanwhile both are sampled"}),

    row<&ViewSettings::environment, &Environment::light>(
        Names{"environment", kEnvironmentLightNames},
        "environment.light",
        {"Light from all around: a studio, or the panorama of --environment-file", "",
         "not off: a lookup at every pixel; its first picture waits a second"}),
    row<&ViewSettings::environment, &Environment::rotation_deg>(
        Range<double>{"environment_rotation", -180, 180},
        "environment.rotation_deg",
        {"Turns it about the world's y, from z towards x", "deg"}),
    row<&ViewSettings::environment, &Environment::strength>(
        Range<double>{"environment_strength", 0, 1'000},
        "environment.strength",
        {"Scales its radiance"}),
    row<&ViewSettings::environment, &Environment::background>(
        Switch{"environment_background"},
        "environment.background",
        {"It shows behind the scene", "", "a pass over the picture"}),
    row<&ViewSettings::environment, &Environment::blur>(
        Range<double>{"environment_blur", 0, 1},
        "environment.blur",
        {"Of what shows there: the roughness of a surface that mirrors it so"}),

    row<&ViewSettings::exposure_mode>(
        Names{"exposure_mode", kExposureModeNames},
        "exposure_mode",
        {"fixed: exposure alone; frame: times what brings this very picture to middle grey", "",
         "frame: two passes over the picture"}),
    row<&ViewSettings::exposure>(
        Range<double>{"exposure", 0.0001, 10'000}, "exposure", {"Multiplies linear radiance"}),
    row<&ViewSettings::tone_map>(
        Names{"tone_map", kToneMapNames}, "tone_map", {"From scene light to display colours"}),
    row<&ViewSettings::toon_outline, &ToonOutline::strength>(
        Range<double>{"outline_strength", 0, 1},
        "toon_outline.strength",
        {"How dark the toon renderers draw edges", "", "above 0: a pass over the picture"}),
    row<&ViewSettings::toon_outline, &ToonOutline::width>(
        Range<double>{"outline_width", 0.0005, 0.01},
        "toon_outline.width",
        {"Of these lines, as a share of the smaller side"}),

    row<&ViewSettings::bloom, &Bloom::kind>(
        Names{"bloom", kBloomKindNames},
        "bloom.kind",
        {"How bright light is spread", "",
         "mip_chain: least; separable: more with the radius, single_pass: with its square"}),
    row<&ViewSettings::bloom, &Bloom::threshold>(Range<double>{"bloom_threshold", 0, 1'000},
                                                 "bloom.threshold",
                                                 {"Exposed radiance from which light is spread"}),
    row<&ViewSettings::bloom, &Bloom::knee>(
        Range<double>{"bloom_knee", 0, 1},
        "bloom.knee",
        {"Share of the threshold over which spreading sets in"}),
    row<&ViewSettings::bloom, &Bloom::strength>(
        Range<double>{"bloom_strength", 0, 1},
        "bloom.strength",
        {"Share of bright light that is spread", "", "0 leaves all of it out"}),
    row<&ViewSettings::bloom, &Bloom::radius>(
        Range<double>{"bloom_radius", 0.001, 0.05},
        "bloom.radius",
        {"Standard deviation of the spread, as a share of the smaller side", "",
         "larger: more, but little by mip_chain"}),
    row<&ViewSettings::antialiasing>(Names{"antialiasing", kAntialiasingNames},
                                     "antialiasing",
                                     {"A filter over the picture, or four samples a pixel", "",
                                      "fxaa: one pass; ssaa4: four times the work"}),

    row<&ViewSettings::fog, &Fog::density>(
        Range<double>{"fog_density", 0, 100},
        "fog.density",
        {"What a medium takes of light in a metre; 0: none", "1/m", "above 0: three passes"}),
    row<&ViewSettings::fog, &Fog::height_falloff>(
        Range<double>{"fog_height_falloff", 0, 100},
        "fog.height_falloff",
        {"A metre above the base height its density falls by this power of e", "1/m", "little"}),
    row<&ViewSettings::fog, &Fog::base_height_m>(Range<double>{"fog_base_height", -1e7, 1e7},
                                                 "fog.base_height_m",
                                                 {"World y up to which its density is whole", "m"}),
    row<&ViewSettings::fog, &Fog::anisotropy>(
        Range<double>{"fog_anisotropy", -0.95, 0.95},
        "fog.anisotropy",
        {"Whether it scatters light onwards (above 0) or back"}),
    row<&ViewSettings::fog, &Fog::albedo>(
        ColorRange{"fog_albedo", 0, 1},
        "fog.albedo",
        {"Share of that light that it scatters", "", "0,0,0 leaves its volume out"}),
    row<&ViewSettings::fog, &Fog::tile_px>(
        Range<uint32_t>{"fog_tile", 4, 64},
        "fog.tile_px",
        {"Pixels from node to node of the volume that lights are scattered in", "px",
         "half of it: four times as much"}),
    row<&ViewSettings::fog, &Fog::slice_count>(
        Range<uint32_t>{"fog_slices", 8, 256},
        "fog.slices",
        {"Slices of that volume", "", "twice as many: twice as much"}),
    row<&ViewSettings::fog, &Fog::half_rate>(
        Switch{"fog_half_rate"},
        "fog.half_rate",
        {"Half its resolution on each axis", "", "an eighth of its time; coarser glows"}),
    row<&ViewSettings::fog, &Fog::noise>(
        Switch{"fog_noise"},
        "fog.noise",
        {"Sample it at places jittered by time, instead of slices' middles"}),

    row<&ViewSettings::shadows, &Shadows::light_count>(
        Range<uint32_t>{"shadow_lights", 0, 32},
        "shadows.lights",
        {"Lights with shadow maps, the most important ones; the others shine through walls", "",
         "each: the scene around it six times; 32 of 512 px: 201 MB a viewer"}),
    row<&ViewSettings::shadows, &Shadows::size_px>(
        Range<uint32_t>{"shadow_size", 64, 512},
        "shadows.size_px",
        {"Pixels of a map's side; a point light has six", "px", "memory grows with its square"}),
};

inline constexpr std::array kEncodingRows = {
    row<&Encoding::quality>(kQualityRange, "quality", {"JPEG quality", "", "higher: more bytes"}),
    row<&Encoding::chroma>(Names{"chroma", kChromaNames},
                           "chroma",
                           {"Colour resolution of pictures", "", "444: more bytes"}),
    row<&Encoding::codec>(
        Names{"codec", kChosenCodecNames},
        "codec",
        {"How pictures are encoded for the stream", "", "vp9: a few times fewer bytes, more work"}),
    row<&Encoding::video_kbps>(kVideoKbpsRange,
                               "video_kbps",
                               {"Bits that a video codec aims at", "kbit/s", "higher: more bytes"}),
};

} // namespace froxel::settings
