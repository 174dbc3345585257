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
        {"Lighting stage", "Shader stage that adds up lights; auto: on a CPU device fragment for "
                           "forward renderers and for light from around alone, else compute"}),
    row<&ViewSettings::shading>(Names{"shading", kShadingModelNames},
                                "shading",
                                {"Shading model",
                                 "Reflection model of surfaces: physically based, its diffuse part "
                                 "alone, or Blinn-Phong highlights",
                                 "", "lambert: a third of the time for each light"}),
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
        {"Light lists", "Lights that each pixel loops over: those listed for its cluster, or all; "
                        "auto: all where lists cannot pay"}),
    row<&ViewSettings::list_cap>(
        Range<uint32_t>{"list_cap", 0, 65'535},
        "list_cap",
        {"List cap", "Most lights that one list keeps, the strongest first; 0: all of them", "",
         "faster, darker; lists are made on the host"}),
    row<&ViewSettings::transparency>(
        Names{"transparency", kTransparencyNames},
        "transparency",
        {"Transparency", "Order in which overlapping blended surfaces are combined", "",
         "weighted: as sorted; peeled: two passes over the glass for each layer"}),
    row<&ViewSettings::peel_layers>(kPeelLayersRange,
                                    "peel_layers",
                                    {"Peeled layers", "Most layers that peeled transparency draws",
                                     "", "each layer: what is visible of it"}),
    row<&ViewSettings::count_pairs>(
        Switch{"count_pairs"},
        "count_pairs",
        {"Count light pairs",
         "Counts the (light, pixel) pairs that are evaluated, and those that add light", "",
         "a pass over all pairs"}),
    row<&ViewSettings::debug, &Debug::view>(
        Names{"debug_view", kDebugViewNames},
        "debug_view",
        {"Debug view", "Picture of the renderer's data, in place of the lit picture or over it", "",
         "no lighting, one pass; lines: one pass more"}),
    row<&ViewSettings::debug, &Debug::scale_max>(
        Range<double>{"debug_scale_max", 0, 1e6},
        "debug_scale_max",
        {"Heat map maximum",
         "Value at the hot end of the debug view's heat map; 0: chosen for each picture"}),

    row<&ViewSettings::lights, &Lights::count>(kLightCountRange,
                                               "lights.count",
                                               {"Number of lights",
                                                "Moving point lights that are placed from the seed",
                                                "", "each light: what its radius reaches"}),
    row<&ViewSettings::lights, &Lights::radius_m>(
        kLightRadiusRange,
        "lights.radius_m",
        {"Light radius", "Distance at which a light's brightness reaches exactly 0", "m",
         "grows with its square and more"}),
    row<&ViewSettings::lights, &Lights::intensity>(
        kLightIntensityRange,
        "lights.intensity",
        {"Light brightness", "Factor on the brightness of every seeded light"}),
    row<&ViewSettings::lights, &Lights::cutoff>(
        Range<double>{"light_cutoff", 0, 1'000},
        "lights.cutoff",
        {"Light cutoff",
         "Irradiance below which a light ends before its radius; 0: no earlier than its radius", "",
         "saves time; darker"}),
    row<&ViewSettings::lights, &Lights::cutoff_compensated>(
        Switch{"light_cutoff_compensated"},
        "lights.cutoff_compensated",
        {"Compensate cutoff", "Brightens lights that the cutoff ends early by what they lose", "",
         "nothing"}),
    row<&ViewSettings::lights, &Lights::seed>(
        Range<uint32_t>{"seed", 0, std::numeric_limits<uint32_t>::max()},
        "lights.seed",
        {"Seed", "Number from which the lights' places, colours and paths are drawn"}),
    row<&ViewSettings::lights, &Lights::places>(Names{"light_places", kLightPlacesNames},
                                                "lights.places",
                                                {"Light places",
                                                 "Space in which the seeded lights move: all of "
                                                 "their box, or close to the scene's surfaces"}),
    row<&ViewSettings::lights, &Lights::palette>(Names{"light_palette", kLightPaletteNames},
                                                 "lights.palette",
                                                 {"Light colours",
                                                  "Colours of the seeded lights: every hue, or "
                                                  "those of flames and bulbs, of daylight, or of "
                                                  "a blue sky"}),
    row<&ViewSettings::lights, &Lights::animate>(Switch{"animate"},
                                                 "lights.animate",
                                                 {"Move lights",
                                                  "Moves the seeded lights along their paths", "",
                                                  "each frame is drawn anew"}),
    row<&ViewSettings::lights, &Lights::speed>(
        Range<double>{"light_speed", 0, 100},
        "lights.speed",
        {"Light speed", "Factor on the speed of the seeded lights"}),
    row<&ViewSettings::lights, &Lights::ambient>(
        Range<double>{"ambient", 0, 1'000},
        "lights.ambient",
        {"Ambient light",
         "Factor on the even light that surfaces get where the environment is off"}),
    row<&ViewSettings::lights, &Lights::scene_lights>(Switch{"scene_lights"},
                                                      "lights.scene_lights",
                                                      {"Lights of the file",
                                                       "Uses the lights that the scene's file has",
                                                       "", "each light: what its radius reaches"}),
    row<&ViewSettings::lights, &Lights::scene_light_intensity>(
        kSceneLightIntensityRange,
        "lights.scene_light_intensity",
        {"File light brightness",
         "Factor on the brightness of every light that the scene's file has"}),

    row<&ViewSettings::animation, &Animation::playing>(
        Switch{"animation_playing"},
        "animation.playing",
        {"Play animation", "Plays the scene's animation", "", "what moves is drawn anew"}),
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
        {"Cross-fade", "Time in which one animation blends into the next", "s",
         "both animations are sampled meanwhile"}),

    row<&ViewSettings::environment, &Environment::light>(
        Names{"environment", kEnvironmentLightNames},
        "environment.light",
        {"Environment light",
         "Light from all around: none, a studio, or the panorama of --environment-file", "",
         "not off: a lookup at every pixel; the first picture waits a second"}),
    row<&ViewSettings::environment, &Environment::rotation_deg>(
        Range<double>{"environment_rotation", -180, 180},
        "environment.rotation_deg",
        {"Environment rotation",
         "Turn of the environment about the world's y axis, from z towards x", "deg"}),
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
        {"Background blur", "Blur of the environment behind the scene, as the roughness of a "
                            "surface that would mirror it so"}),

    row<&ViewSettings::background, &Background::color>(
        ColorRange{"background_color", 0, 1},
        "background.color",
        {"Background colour", "Colour where nothing is drawn, whatever the exposure; linear"}),
    row<&ViewSettings::background, &Background::gradient>(
        Range<double>{"background_gradient", 0, 1},
        "background.gradient",
        {"Background gradient",
         "Share by which the background is lighter at its top than halfway up, and darker at its "
         "bottom"}),

    row<&ViewSettings::exposure_mode>(
        Names{"exposure_mode", kExposureModeNames},
        "exposure_mode",
        {"Exposure mode",
         "Exposure by hand (fixed), or brought to middle grey for each frame (frame)", "",
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
        {"Toon bands",
         "Steps of brightness that the toon renderers bring light to; 0 keeps it smooth"}),
    row<&ViewSettings::toon, &Toon::rim>(
        Range<double>{"toon_rim", 0, 4},
        "toon.rim",
        {"Toon rim", "Share of light that toon surfaces scatter besides where they turn away"}),
    row<&ViewSettings::toon, &Toon::rim_width>(
        Range<double>{"toon_rim_width", 0, 1},
        "toon.rim_width",
        {"Toon rim width", "Cosine between surface and view below which a toon surface is a rim"}),
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
         "mip_chain: least; separable: more with the radius; single_pass: with its square"}),
    row<&ViewSettings::bloom, &Bloom::threshold>(
        Range<double>{"bloom_threshold", 0, 1'000},
        "bloom.threshold",
        {"Bloom threshold", "Exposed brightness above which light glows"}),
    row<&ViewSettings::bloom, &Bloom::knee>(
        Range<double>{"bloom_knee", 0, 1},
        "bloom.knee",
        {"Bloom knee", "Share of the bloom threshold over which the glow sets in"}),
    row<&ViewSettings::bloom, &Bloom::strength>(Range<double>{"bloom_strength", 0, 1},
                                                "bloom.strength",
                                                {"Bloom strength",
                                                 "Share of bright light that goes into the glow",
                                                 "", "0 leaves all of it out"}),
    row<&ViewSettings::bloom, &Bloom::radius>(
        Range<double>{"bloom_radius", 0.001, 0.05},
        "bloom.radius",
        {"Bloom radius", "Standard deviation of the glow, as a share of the picture's smaller side",
         "", "larger: more, but little by mip_chain"}),
    row<&ViewSettings::antialiasing>(Names{"antialiasing", kAntialiasingNames},
                                     "antialiasing",
                                     {"Antialiasing",
                                      "Smoothing of edges: a filter over the picture (fxaa), "
                                      "four samples for each pixel (ssaa4), or 16 that only "
                                      "stills have (mean16)",
                                      "",
                                      "fxaa: one pass; ssaa4: four times the work; mean16: "
                                      "sixteen times"}),

    row<&ViewSettings::fog, &Fog::density>(
        Range<double>{"fog_density", 0, 100},
        "fog.density",
        {"Fog density",
         "Share of light that fog takes in a metre, as the extinction coefficient; 0: no fog",
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
        {"Fog anisotropy", "Direction in which fog scatters light: onwards above 0, back below 0"}),
    row<&ViewSettings::fog, &Fog::albedo>(
        ColorRange{"fog_albedo", 0, 1},
        "fog.albedo",
        {"Fog colour", "Share of the light taken by fog that it scatters instead of absorbing", "",
         "0,0,0 leaves its volume out"}),
    row<&ViewSettings::fog, &Fog::tile_px>(
        Range<uint32_t>{"fog_tile", 4, 64},
        "fog.tile_px",
        {"Fog tile", "Distance in pixels between neighbouring nodes of the fog volume", "px",
         "half of it: four times as much"}),
    row<&ViewSettings::fog, &Fog::slice_count>(Range<uint32_t>{"fog_slices", 8, 256},
                                               "fog.slices",
                                               {"Fog slices",
                                                "Number of depth slices of the fog volume", "",
                                                "twice as many: twice as much"}),
    row<&ViewSettings::fog, &Fog::half_rate>(
        Switch{"fog_half_rate"},
        "fog.half_rate",
        {"Fog at half rate", "Halves the fog volume's resolution along each axis", "",
         "saves seven eighths of its time; coarser glows"}),
    row<&ViewSettings::fog, &Fog::noise>(
        Switch{"fog_noise"},
        "fog.noise",
        {"Fog jitter",
         "Samples the fog volume at jittered places in place of the middle of each slice"}),

    row<&ViewSettings::shadows, &Shadows::light_count>(
        Range<uint32_t>{"shadow_lights", 0, 32},
        "shadows.lights",
        {"Lights with shadows",
         "Number of lights that cast shadows, the most important ones; the others shine through "
         "walls",
         "", "each light: the scene around it six times; 32 lights of 512 px: 201 MB a viewer"}),
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
    row<&Encoding::codec>(Names{"codec", kChosenCodecNames},
                          "codec",
                          {"Codec", "Encoding of pictures in the stream", "",
                           "vp9: a few times fewer bytes, more work"}),
    row<&Encoding::video_kbps>(
        kVideoKbpsRange,
        "video_kbps",
        {"Video bit rate", "Bit rate that a video codec aims at", "kbit/s", "higher: more bytes"}),
};

} // namespace froxel::settings
