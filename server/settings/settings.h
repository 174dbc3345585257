// Everything that a viewer can ask for: plain values with their defaults. A frame is a pure
// function of (scene, ViewSettings, time). Ranges are in ranges.h.
#pragma once

#include "core/math.h"
#include "settings/camera.h"
#include "settings/codecs.h"
#include "settings/debug_view.h"
#include "settings/placed_lights.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace froxel::settings {

enum class Renderer : uint8_t {
    kNaive,
    kForwardPlus,
    kClusteredDeferred,
    kToonFragment,
    kToonCompute,
};
inline constexpr std::array kRendererNames = {
    std::string_view("naive"), std::string_view("forward_plus"),
    std::string_view("clustered_deferred"), std::string_view("toon_fragment"),
    std::string_view("toon_compute")};

// Where lights are added up. auto: in compute, but for the forward renderers on a CPU device and
// where descriptor indexing is absent: there in the fragment stage. A forward renderer in compute
// is its twin: a thin prepass leaves which triangle each pixel shows, and a compute pass fetches
// the material and shades.
enum class LightingStage : uint8_t { kAuto, kCompute, kFragment };
inline constexpr std::array kLightingStageNames = {
    std::string_view("auto"), std::string_view("compute"), std::string_view("fragment")};

// How a surface answers light. pbr: glTF's metallic-roughness model. lambert: its diffuse part
// alone. blinn_phong: pbr's colours with Blinn's highlight, whose shininess comes from roughness.
enum class ShadingModel : uint8_t { kPbr, kLambert, kBlinnPhong };
inline constexpr std::array kShadingModelNames = {
    std::string_view("pbr"), std::string_view("lambert"), std::string_view("blinn_phong")};

// How slices divide depth. Never changes the picture.
enum class GridLaw : uint8_t { kLogarithmic, kLinear, kHyperbolic };
inline constexpr std::array kGridLawNames = {
    std::string_view("logarithmic"), std::string_view("linear"), std::string_view("hyperbolic")};

// Where seeded lights are: all over the box that they move in, or hovering at surfaces.
enum class LightPlaces : uint8_t { kVolume, kSurfaces };
inline constexpr std::array kLightPlacesNames = {std::string_view("volume"),
                                                 std::string_view("surfaces")};

// Colours that seeded lights have.
enum class LightPalette : uint8_t { kRainbow, kWarm, kWhite, kCool };
inline constexpr std::array kLightPaletteNames = {
    std::string_view("rainbow"), std::string_view("warm"), std::string_view("white"),
    std::string_view("cool")};

// Which lights a pixel loops over. auto: all of them where lists cannot pay. Never changes the
// picture.
enum class LightLoop : uint8_t { kAuto, kLists, kAllLights };
inline constexpr std::array kLightLoopNames = {std::string_view("auto"), std::string_view("lists"),
                                               std::string_view("all_lights")};

// How the G-buffer holds the normal: octahedral with bits a component, or as the seeds had it
// (three halves, two halves and a rebuilt z, a spheremap in two halves).
enum class NormalEncoding : uint8_t { kOct16, kOct12, kOct10, kOct8, kXyz16, kXy16, kSpheremap16 };
inline constexpr std::array kNormalEncodingNames = {
    std::string_view("oct16"),      std::string_view("oct12"), std::string_view("oct10"),
    std::string_view("oct8"),       std::string_view("xyz16"), std::string_view("xy16"),
    std::string_view("spheremap16")};

// Where the lighting pass takes a pixel's position from: the depth buffer, a stored depth, or a
// stored position.
enum class PositionSource : uint8_t { kDepth, kStoredDepth, kFp32, kFp16 };
inline constexpr std::array kPositionSourceNames = {
    std::string_view("depth"), std::string_view("stored_depth"), std::string_view("fp32"),
    std::string_view("fp16")};

// What multiplies linear radiance. fixed: the setting `exposure` alone. frame: that, times what
// brings the middle of this very frame's luminance to middle grey; no frame depends on another.
enum class ExposureMode : uint8_t { kFixed, kFrame };
inline constexpr std::array kExposureModeNames = {std::string_view("fixed"),
                                                  std::string_view("frame")};

enum class ToneMap : uint8_t { kPbrNeutral, kClamp };
inline constexpr std::array kToneMapNames = {std::string_view("pbr_neutral"),
                                             std::string_view("clamp")};

// How bright light is spread. All kinds come to a Gaussian of one standard deviation: as one
// kernel, along rows and columns, by a wavelet with holes, or down and up a chain of halved
// pictures.
enum class BloomKind : uint8_t { kNone, kSinglePass, kSeparable, kATrous, kMipChain };
inline constexpr std::array kBloomKindNames = {
    std::string_view("none"), std::string_view("single_pass"), std::string_view("separable"),
    std::string_view("a_trous"), std::string_view("mip_chain")};

// fxaa: a filter over the finished picture. ssaa4: four samples a pixel, tone mapped one by one.
// mean16: the mean of 16 frames of a sample each (samples.h), for whoever draws stills; one frame
// by itself, such as those of a view that moves, is as without.
enum class Antialiasing : uint8_t { kNone, kFxaa, kSsaa4, kMean16 };
inline constexpr std::array kAntialiasingNames = {
    std::string_view("none"), std::string_view("fxaa"), std::string_view("ssaa4"),
    std::string_view("mean16")};
// Samples across a pixel, and down it.
[[nodiscard]] constexpr uint32_t samplesAcross(Antialiasing antialiasing) {
    return antialiasing == Antialiasing::kSsaa4 ? 2 : 1;
}

// How blended surfaces that overlap come together. sorted: whole instances from far to near, wrong
// where they interlace. weighted: all at once, by weights of distance; approximate in any order.
// peeled: layer by layer from the eye, exact up to a number of layers.
enum class Transparency : uint8_t { kSorted, kWeighted, kPeeled };
inline constexpr std::array kTransparencyNames = {
    std::string_view("sorted"), std::string_view("weighted"), std::string_view("peeled")};

enum class Chroma : uint8_t { k420, k444 };
inline constexpr std::array kChromaNames = {std::string_view("420"), std::string_view("444")};

// How far a picture is refined that rests: as asked for, at high quality, or in the end without
// loss.
enum class Refine : uint8_t { kNone, kHigh, kLossless };
inline constexpr std::array kRefineNames = {std::string_view("none"), std::string_view("high"),
                                            std::string_view("lossless")};

// What an animation does at its ends.
enum class Repeat : uint8_t { kLoop, kPingPong, kOnce };
inline constexpr std::array kRepeatNames = {std::string_view("loop"), std::string_view("ping_pong"),
                                            std::string_view("once")};

struct Size {
    uint32_t width_px = 1280;
    uint32_t height_px = 720;
    bool operator==(const Size&) const = default;
};

// Width over height.
[[nodiscard]] inline double aspectOf(const Size& size) {
    return static_cast<double>(size.width_px) / size.height_px;
}

struct GridSize {
    uint32_t x = 16;
    uint32_t y = 9;
    uint32_t z = 24;
    bool operator==(const GridSize&) const = default;
};

struct Grid {
    bool automatic = true; // size by a cost model; else the one given
    GridSize size;         // not automatic
    GridLaw law = GridLaw::kLogarithmic;
    bool operator==(const Grid&) const = default;
};

// Only the deferred renderers have one. Anything but the default trades error for bytes.
struct GbufferLayout {
    NormalEncoding normal = NormalEncoding::kOct16;
    PositionSource position = PositionSource::kDepth;
    bool operator==(const GbufferLayout&) const = default;
};

struct Lights {
    uint32_t count = 1000;  // seeded point lights
    float radius_m = 2.0F;  // where a light's contribution reaches exactly 0
    float intensity = 1.0F; // scales every seeded light
    float cutoff = 0.0F;    // trades error for speed: a light ends where its irradiance, facing
                            // it, would fall to this before its window; 0: at its radius
    bool cutoff_compensated = false; // lights that end early are brighter by what they lost
    uint32_t seed = 1;
    LightPlaces places = LightPlaces::kVolume;
    LightPalette palette = LightPalette::kRainbow;
    bool animate = true;                // off: time stands still
    float speed = 1.0F;                 // scales the animation's clock
    std::optional<BoundsD3> box;        // none: the scene's bounds
    float ambient = 1.0F;               // scales the ambient term
    bool scene_lights = true;           // the scene's own punctual lights
    float scene_light_intensity = 1.0F; // scales each of them: files count light in any unit
    PlacedLights placed;                // those that viewers placed
    bool operator==(const Lights&) const = default;
};

// Spreads a share of what is bright; none is lost. Lengths are shares of the picture's smaller
// side, so that a picture of another size looks the same.
struct Bloom {
    BloomKind kind = BloomKind::kNone;
    float threshold = 1.0F; // exposed radiance from which light is spread; 0: all light
    float knee = 0.5F;      // share of the threshold over which spreading sets in
    float strength = 0.25F; // share of that light that is spread
    float radius = 0.015F;  // the Gaussian's standard deviation
    bool operator==(const Bloom&) const = default;
};

// A medium that absorbs light and scatters it once: `density` up to the base height, falling off
// exponentially above it. Scattering of lights is sampled in a froxel volume; what is lost on the
// way, and what comes from all around, has a closed form.
struct Fog {
    float density = 0;         // extinction, 1/m; 0: none
    float height_falloff = 0;  // 1/m: e times less every 1 / height_falloff; 0: the same everywhere
    double base_height_m = 0;  // world y
    float anisotropy = 0;      // Henyey-Greenstein's g; above 0: mostly onwards
    glm::vec3 albedo{1};       // share of the extinction that scatters
    uint32_t tile_px = 16;     // from node to node of the volume, across and down
    uint32_t slice_count = 64; // of the volume
    bool half_rate = false;    // half the volume's resolution on each axis
    bool noise = false;        // places in slices jittered by time, instead of their middles
    bool operator==(const Fog&) const = default;

    [[nodiscard]] bool present() const { return density > 0; }
    [[nodiscard]] bool scatters() const {
        return present() && (albedo.x > 0 || albedo.y > 0 || albedo.z > 0);
    }
};

// Of the toon renderers: light in steps, and more of it on surfaces that turn away from the eye.
struct Toon {
    uint32_t bands = 3; // that a light's irradiance, or the lit colour, is brought to; 0: smooth
    float rim = 0.5F;   // how much more of the lights' light a rim scatters; 0: none
    float rim_width = 0.2F; // n.v below which a surface is a rim
    bool operator==(const Toon&) const = default;
};

// Of the toon renderers: edges of depth and normals are darkened.
struct ToonOutline {
    float strength = 0.0F; // 0: none; 1: black
    float width = 0.003F;  // share of the picture's smaller side
    bool operator==(const ToonOutline&) const = default;
};

// Maps of the point and spot lights that matter most to a view; the others light through walls.
struct Shadows {
    uint32_t light_count = 0; // lights with maps, at most; 0: none
    uint32_t size_px = 256;   // of a map's side; a point light has six of them
    bool operator==(const Shadows&) const = default;
};

// Light from all around, in the ambient light's place. studio: a grey room with soft boxes. file:
// the panorama that the server was given.
enum class EnvironmentLight : uint8_t { kOff, kStudio, kFile };
inline constexpr std::array kEnvironmentLightNames = {
    std::string_view("off"), std::string_view("studio"), std::string_view("file")};

struct Environment {
    EnvironmentLight light = EnvironmentLight::kOff;
    float rotation_deg = 0;  // about +Y by the right hand's rule: +Z goes towards +X
    float strength = 1;      // multiplies its radiance
    bool background = false; // it shows behind the scene
    float blur = 0.3F;       // as a surface of this roughness mirrors it
    bool operator==(const Environment&) const = default;

    [[nodiscard]] bool present() const { return light != EnvironmentLight::kOff; }
};

// Where nothing is drawn: a colour of the display (linear), whatever the exposure.
struct Background {
    glm::vec3 color{0.0006F, 0.0037F, 0.0103F}; // halfway up the picture
    float gradient = 0; // 1: black at the bottom, twice the colour at the top
    bool operator==(const Background&) const = default;
};

// How the scene's own animations play, by a clock of their own.
struct Animation {
    uint32_t number = 0; // of the scene's, from 1; 0: none, the rest pose
    bool playing = true;
    float speed = 1; // below 0: backwards
    Repeat repeat = Repeat::kLoop;
    float fade_s = 0; // that the way from one animation to another takes
    bool operator==(const Animation&) const = default;
};

// A cubic Hermite ramp from [0, 1] to [0, 1]: points in ascending x; constant outside.
struct ToonRamp {
    static constexpr uint32_t kMaxPoints = 8;
    struct Point {
        float x = 0;
        float y = 0;
        float slope = 0;
        bool operator==(const Point&) const = default;
    };
    uint32_t count = 8;
    std::array<Point, kMaxPoints> points = {
        Point{0.00F, 0.00F, 0}, {0.10F, 0.00F, 0}, {0.16F, 0.35F, 0}, {0.45F, 0.35F, 0},
        {0.52F, 0.70F, 0},      {0.80F, 0.70F, 0}, {0.86F, 1.00F, 0}, {1.00F, 1.00F, 0}};
    bool operator==(const ToonRamp&) const = default;
};

struct ViewSettings {
    Camera camera;
    Size size;
    Renderer renderer = Renderer::kClusteredDeferred;
    LightingStage lighting = LightingStage::kAuto;
    ShadingModel shading = ShadingModel::kPbr;
    GbufferLayout gbuffer;
    Grid grid;
    LightLoop light_loop = LightLoop::kAuto;
    uint32_t list_cap = 0; // trades error for speed: lights that a list keeps at most, those that
                           // can add most; 0: all that reach it
    bool count_pairs = false; // count evaluated and contributing light-pixel pairs; costs time
    Debug debug;
    float geometry_error_px = 0; // trades error for speed: surfaces may be so far off their place
    Transparency transparency = Transparency::kSorted;
    uint32_t peel_layers = 4; // at most, while peeled; pixels with more are counted
    Lights lights;
    Shadows shadows;
    Environment environment;
    Background background;
    Animation animation;
    uint32_t material_variant = 0; // of the scene's, from 1; 0: none
    ExposureMode exposure_mode = ExposureMode::kFixed;
    float exposure = 1.0F; // multiplies linear radiance before the tone map
    ToneMap tone_map = ToneMap::kPbrNeutral;
    ToonRamp toon_fragment; // over each light's n.l
    // Over the norm of the accumulated colour; dark pixels keep some of their shade.
    ToonRamp toon_compute{.count = 8,
                          .points = {ToonRamp::Point{0.00F, 0.00F, 2},
                                     {0.03F, 0.04F, 0},
                                     {0.10F, 0.06F, 0},
                                     {0.14F, 0.22F, 0},
                                     {0.30F, 0.25F, 0},
                                     {0.38F, 0.55F, 0},
                                     {0.65F, 0.60F, 0},
                                     {0.80F, 1.00F, 0}}};
    Toon toon;
    ToonOutline toon_outline;
    Bloom bloom;
    Fog fog;
    Antialiasing antialiasing = Antialiasing::kNone;
    bool operator==(const ViewSettings&) const = default;
};

struct Encoding {
    uint32_t quality = 80; // 1..100, with RateControl::kQuality
    Chroma chroma = Chroma::k420;
    Codec codec = kPlainCodec;
    uint32_t video_kbps = 6000; // with RateControl::kBitrate: 1000 bits a second, aimed at
    bool operator==(const Encoding&) const = default;
};

} // namespace froxel::settings
