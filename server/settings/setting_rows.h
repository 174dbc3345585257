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
    row<&ViewSettings::renderer>(
        Names{"renderer", kRendererNames},
        "renderer",
        {"Renderer", "Algorithm that draws and lights the scene", "",
         "naive: every light at every pixel; the others: the lights that reach a pixel"}),
    row<&ViewSettings::lighting>(
        Names{"lighting", kLightingStageNames},
        "lighting",
        {"Lighting stage",
         "Shader stage that adds up lights; auto: compute, except on a CPU device, where forward "
         "renderers and pictures with the environment alone use fragment"}),
    row<&ViewSettings::shading>(Names{"shading", kShadingModelNames},
                                "shading",
                                {"Shading model",
                                 "Reflection model of surfaces: physically based, its diffuse part "
                                 "alone, or Blinn-Phong highlights",
                                 "", "lambert: each light takes a third of the time"}),
    row<&ViewSettings::gbuffer, &GbufferLayout::normal>(
        Names{"gbuffer_normal", kNormalEncodingNames},
        "gbuffer.normal",
        {"G-buffer normals", "Encoding of normals in the G-buffer of deferred renderers", "",
         "fewer bits: less memory traffic, more error"}),
    row<&ViewSettings::gbuffer, &GbufferLayout::position>(
        Names{"gbuffer_position", kPositionSourceNames},
        "gbuffer.position",
        {"G-buffer positions",
         "Source of positions for deferred lighting: rebuilt from depth, or stored", "",
         "a stored one: more memory traffic"}),
    row<&ViewSettings::grid, &Grid::law>(
        Names{"grid_law", kGridLawNames},
        "grid_law",
        {"Depth slices", "Spacing of the cluster grid's slices along depth"}),
    row<&ViewSettings::light_loop>(
        Names{"light_loop", kLightLoopNames},
        "light_loop",
        {"Light lists", "Lights that each pixel loops over: those in its cluster's list, or all; "
                        "auto: all if lists save no time"}),
    row<&ViewSettings::list_cap>(
        Range<uint32_t>{"list_cap", 0, 65'535},
        "list_cap",
        {"List cap", "Maximum number of lights in a list, the strongest ones; 0: no limit", "",
         "faster and darker; the host builds the lists"}),
    row<&ViewSettings::geometry_error_px>(
        Range<double>{"geometry_error", 0, 100},
        "geometry_error_px",
        {"Geometry error",
         "Maximum distance in the picture between a surface as drawn and its full model, where the "
         "server keeps coarser levels of the scene; 0: the full model",
         "px", "more: fewer triangles"}),
    row<&ViewSettings::transparency>(
        Names{"transparency", kTransparencyNames},
        "transparency",
        {"Transparency", "Order in which overlapping blended surfaces are combined", "",
         "weighted: same as sorted; peeled: two passes over blended surfaces for each layer"}),
    row<&ViewSettings::peel_layers>(kPeelLayersRange,
                                    "peel_layers",
                                    {"Peeled layers",
                                     "Maximum number of layers of peeled transparency", "",
                                     "each layer: its visible pixels"}),
    row<&ViewSettings::count_pairs>(
        Switch{"count_pairs"},
        "count_pairs",
        {"Count light pairs",
         "Counts the (light, pixel) pairs that are evaluated, and those that add light", "",
         "a pass over all pairs"}),
    row<&ViewSettings::debug, &Debug::view>(
        Names{"debug_view", kDebugViewNames},
        "debug_view",
        {"Debug view", "View of the renderer's data, in place of the lit picture or over it", "",
         "no lighting, one pass; lines: one pass more"}),
    row<&ViewSettings::debug, &Debug::scale_max>(
        Range<double>{"debug_scale_max", 0, 1e6},
        "debug_scale_max",
        {"Heat map maximum",
         "Value at the hot end of the debug view's heat map; 0: chosen for each picture"}),

    row<&ViewSettings::lights, &Lights::count>(kLightCountRange,
                                               "lights.count",
                                               {"Number of lights",
                                                "Number of moving point lights, placed by the seed",
                                                "", "each light: the pixels within its radius"}),
    row<&ViewSettings::lights, &Lights::radius_m>(
        kLightRadiusRange,
        "lights.radius_m",
        {"Light radius", "Distance at which a light's brightness reaches exactly 0", "m",
         "grows at least with its square"}),
    row<&ViewSettings::lights, &Lights::intensity>(
        kLightIntensityRange,
        "lights.intensity",
        {"Light brightness", "Factor on the brightness of every seeded light"}),
    row<&ViewSettings::lights, &Lights::cutoff>(
        Range<double>{"light_cutoff", 0, 1'000},
        "lights.cutoff",
        {"Light cutoff",
         "Irradiance at which a light ends before its radius; 0: never before its radius", "",
         "saves time; darker"}),
    row<&ViewSettings::lights, &Lights::cutoff_compensated>(
        Switch{"light_cutoff_compensated"},
        "lights.cutoff_compensated",
        {"Compensate cutoff", "Brightens lights by the light that the cutoff removes", "",
         "nothing"}),
    row<&ViewSettings::lights, &Lights::seed>(
        Range<uint32_t>{"seed", 0, std::numeric_limits<uint32_t>::max()},
        "lights.seed",
        {"Seed", "Random seed of the lights' positions, colours and paths"}),
    row<&ViewSettings::lights, &Lights::places>(Names{"light_places", kLightPlacesNames},
                                                "lights.places",
                                                {"Light places",
                                                 "Space in which the seeded lights move: all of "
                                                 "their box, or close to the scene's surfaces"}),
    row<&ViewSettings::lights, &Lights::palette>(
        Names{"light_palette", kLightPaletteNames},
        "lights.palette",
        {"Light colours",
         "Colours of the seeded lights: every hue, flames and bulbs, daylight, or a blue sky"}),
    row<&ViewSettings::lights, &Lights::animate>(Switch{"animate"},
                                                 "lights.animate",
                                                 {"Move lights",
                                                  "Moves the seeded lights along their paths", "",
                                                  "every frame must be drawn"}),
    row<&ViewSettings::lights, &Lights::speed>(
        Range<double>{"light_speed", 0, 100},
        "lights.speed",
        {"Light speed", "Factor on the speed of the seeded lights"}),
    row<&ViewSettings::lights, &Lights::ambient>(
        Range<double>{"ambient", 0, 1'000},
        "lights.ambient",
        {"Ambient light", "Factor on the constant light of surfaces while the environment is off"}),
    row<&ViewSettings::lights, &Lights::scene_lights>(Switch{"scene_lights"},
                                                      "lights.scene_lights",
                                                      {"Lights of the file",
                                                       "Uses the lights of the scene's file", "",
                                                       "each light: the pixels within its radius"}),
    row<&ViewSettings::lights, &Lights::scene_light_intensity>(
        kSceneLightIntensityRange,
        "lights.scene_light_intensity",
        {"File light brightness", "Factor on the brightness of every light of the scene's file"}),

    row<&ViewSettings::animation, &Animation::playing>(
        Switch{"animation_playing"},
        "animation.playing",
        {"Play animation", "Plays the scene's animation", "",
         "moving surfaces are drawn in every frame"}),
    row<&ViewSettings::animation, &Animation::speed>(
        Range<double>{"animation_speed", -100, 100},
        "animation.speed",
        {"Animation speed", "Factor on the speed of the scene's animation; below 0: backwards"}),
    row<&ViewSettings::animation, &Animation::repeat>(
        Names{"animation_repeat", kRepeatNames},
        "animation.repeat",
        {"Animation repeat", "Behaviour of the scene's animation when it reaches an end"}),
    row<&ViewSettings::animation, &Animation::fade_s>(
        Range<double>{"animation_fade", 0, 10},
        "animation.fade_s",
        {"Cross-fade", "Duration of the transition to another animation", "s",
         "both animations are sampled during the transition"}),

    row<&ViewSettings::environment, &Environment::light>(
        Names{"environment", kEnvironmentLightNames},
        "environment.light",
        {"Environment light",
         "Light from all directions: none, a studio, or the panorama of --environment-file", "",
         "not off: a lookup at every pixel"}),
    row<&ViewSettings::environment, &Environment::rotation_deg>(
        Range<double>{"environment_rotation", -180, 180},
        "environment.rotation_deg",
        {"Environment rotation",
         "Rotation of the environment about the world's y axis, from z towards x", "deg"}),
    row<&ViewSettings::environment, &Environment::strength>(
        Range<double>{"environment_strength", 0, 1'000},
        "environment.strength",
        {"Environment brightness", "Factor on the light from the environment"}),
    row<&ViewSettings::environment, &Environment::background>(
        Switch{"environment_background"},
        "environment.background",
        {"Environment as background", "Shows the environment behind the scene", "",
         "a pass over the picture"}),
    row<&ViewSettings::environment, &Environment::blur>(
        Range<double>{"environment_blur", 0, 1},
        "environment.blur",
        {"Background blur",
         "Blur of the environment behind the scene, as the roughness of an equivalent mirror"}),

    row<&ViewSettings::background, &Background::color>(
        ColorRange{"background_color", 0, 1},
        "background.color",
        {"Background colour", "Colour where nothing is drawn, whatever the exposure; linear"}),
    row<&ViewSettings::background, &Background::gradient>(
        Range<double>{"background_gradient", 0, 1},
        "background.gradient",
        {"Background gradient", "Fraction by which the background is lighter at the top, and "
                                "darker at the bottom, than in the middle"}),

    row<&ViewSettings::exposure_mode>(
        Names{"exposure_mode", kExposureModeNames},
        "exposure_mode",
        {"Exposure mode", "Fixed exposure, or exposure of each frame to middle grey (frame)", "",
         "frame: two passes over the picture"}),
    row<&ViewSettings::exposure>(Range<double>{"exposure", 0.0001, 10'000},
                                 "exposure",
                                 {"Exposure", "Factor on scene light before tone mapping"}),
    row<&ViewSettings::tone_map>(Names{"tone_map", kToneMapNames},
                                 "tone_map",
                                 {"Tone mapping", "Curve from scene light to display colours"}),
    row<&ViewSettings::toon, &Toon::bands>(
        Range<uint32_t>{"toon_bands", 0, 8},
        "toon.bands",
        {"Toon bands", "Number of brightness steps of the toon renderers; 0: smooth"}),
    row<&ViewSettings::toon, &Toon::rim>(
        Range<double>{"toon_rim", 0, 4},
        "toon.rim",
        {"Toon rim", "Extra scattered light where toon surfaces turn away from the eye"}),
    row<&ViewSettings::toon, &Toon::rim_width>(
        Range<double>{"toon_rim_width", 0, 1},
        "toon.rim_width",
        {"Toon rim width", "Cosine between surface and view direction below which the rim begins"}),
    row<&ViewSettings::toon_outline, &ToonOutline::strength>(
        Range<double>{"outline_strength", 0, 1},
        "toon_outline.strength",
        {"Outline strength", "Darkness of the outlines that the toon renderers draw at edges", "",
         "above 0: a pass over the picture"}),
    row<&ViewSettings::toon_outline, &ToonOutline::width>(
        Range<double>{"outline_width", 0.0005, 0.01},
        "toon_outline.width",
        {"Outline width", "Width of toon outlines, as a share of the picture's smaller side"}),

    row<&ViewSettings::bloom, &Bloom::kind>(
        Names{"bloom", kBloomKindNames},
        "bloom.kind",
        {"Bloom", "Filter that spreads bright light into a glow", "",
         "mip_chain: least; separable: grows with the radius; single_pass: with its square"}),
    row<&ViewSettings::bloom, &Bloom::threshold>(
        Range<double>{"bloom_threshold", 0, 1'000},
        "bloom.threshold",
        {"Bloom threshold", "Exposed brightness above which light glows"}),
    row<&ViewSettings::bloom, &Bloom::knee>(
        Range<double>{"bloom_knee", 0, 1},
        "bloom.knee",
        {"Bloom knee", "Width of the soft knee, as a fraction of the bloom threshold"}),
    row<&ViewSettings::bloom, &Bloom::strength>(
        Range<double>{"bloom_strength", 0, 1},
        "bloom.strength",
        {"Bloom strength", "Fraction of bright light that spreads", "", "0 skips the effect"}),
    row<&ViewSettings::bloom, &Bloom::radius>(
        Range<double>{"bloom_radius", 0.001, 0.05},
        "bloom.radius",
        {"Bloom radius", "Standard deviation of the glow, as a share of the picture's smaller side",
         "", "larger: more, but little with mip_chain"}),
    row<&ViewSettings::antialiasing>(
        Names{"antialiasing", kAntialiasingNames},
        "antialiasing",
        {"Antialiasing",
         "Smoothing of edges: a filter over the picture (fxaa), four samples for each pixel "
         "(ssaa4), or 16, only for stills (mean16)",
         "",
         "fxaa: one pass; ssaa4: four times the work; mean16: "
         "sixteen times"}),

    row<&ViewSettings::fog, &Fog::density>(
        Range<double>{"fog_density", 0, 100},
        "fog.density",
        {"Fog density",
         "Fraction of light that fog removes in a metre, as the extinction coefficient; 0: no fog",
         "1/m", "above 0: three passes"}),
    row<&ViewSettings::fog, &Fog::height_falloff>(
        Range<double>{"fog_height_falloff", 0, 100},
        "fog.height_falloff",
        {"Fog height falloff",
         "Rate at which fog thins out with height above its base, as a power of e for each metre",
         "1/m", "little"}),
    row<&ViewSettings::fog, &Fog::base_height_m>(
        Range<double>{"fog_base_height", -1e7, 1e7},
        "fog.base_height_m",
        {"Fog base height", "Height (world y) below which fog has its full density", "m"}),
    row<&ViewSettings::fog, &Fog::anisotropy>(
        Range<double>{"fog_anisotropy", -0.95, 0.95},
        "fog.anisotropy",
        {"Fog anisotropy",
         "Direction in which fog scatters light: forwards above 0, backwards below 0"}),
    row<&ViewSettings::fog, &Fog::albedo>(
        ColorRange{"fog_albedo", 0, 1},
        "fog.albedo",
        {"Fog colour", "Fraction of the removed light that fog scatters instead of absorbing", "",
         "0,0,0 skips the volume"}),
    row<&ViewSettings::fog, &Fog::tile_px>(
        Range<uint32_t>{"fog_tile", 4, 64},
        "fog.tile_px",
        {"Fog tile", "Distance in pixels between neighbouring nodes of the fog volume", "px",
         "half the size: four times the work"}),
    row<&ViewSettings::fog, &Fog::slice_count>(Range<uint32_t>{"fog_slices", 8, 256},
                                               "fog.slices",
                                               {"Fog slices",
                                                "Number of depth slices of the fog volume", "",
                                                "twice as many: twice the work"}),
    row<&ViewSettings::fog, &Fog::half_rate>(
        Switch{"fog_half_rate"},
        "fog.half_rate",
        {"Fog at half rate", "Halves the fog volume's resolution along each axis", "",
         "saves seven eighths of its time; coarser glows"}),
    row<&ViewSettings::fog, &Fog::noise>(
        Switch{"fog_noise"},
        "fog.noise",
        {"Fog jitter",
         "Samples the fog volume at jittered positions instead of the middle of each slice"}),

    row<&ViewSettings::shadows, &Shadows::light_count>(
        Range<uint32_t>{"shadow_lights", 0, 32},
        "shadows.lights",
        {"Lights with shadows",
         "Number of lights that cast shadows, the most important ones; the others shine through "
         "walls",
         "",
         "each light: its surroundings are drawn six times; 32 lights of 512 px: 201 MB for each "
         "viewer"}),
    row<&ViewSettings::shadows, &Shadows::size_px>(
        Range<uint32_t>{"shadow_size", 64, 512},
        "shadows.size_px",
        {"Shadow map size", "Side of a shadow map in pixels; a point light has six maps", "px",
         "memory grows with its square"}),
};

inline constexpr std::array kEncodingRows = {
    row<&Encoding::quality>(
        kQualityRange,
        "quality",
        {"JPEG quality", "Quality of JPEG pictures in the stream", "", "higher: more bytes"}),
    row<&Encoding::chroma>(
        Names{"chroma", kChromaNames},
        "chroma",
        {"Chroma subsampling", "Colour resolution of streamed pictures", "", "444: more bytes"}),
    row<&Encoding::codec>(Names{"codec", kChosenCodecNames, kAllCodecNames},
                          "codec",
                          {"Codec", "Encoding of pictures in the stream", "",
                           "vp9: a few times fewer bytes, more encoder work"}),
    row<&Encoding::video_kbps>(
        kVideoKbpsRange,
        "video_kbps",
        {"Video bit rate", "Bit rate that a video codec aims at", "kbit/s", "higher: more bytes"}),
};

} // namespace froxel::settings
