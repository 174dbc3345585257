// Everything that a viewer can ask for: plain values with their defaults. A frame is a pure
// function of (scene, ViewSettings, time). Ranges are in ranges.h.
#pragma once

#include "core/math.h"
#include "view/camera.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace froxel::view {

enum class Renderer : uint8_t {
    kNaive,
    kForwardPlus,
    kClusteredDeferred,
    kToonFragment,
    kToonCompute,
};
inline constexpr std::array kRendererNames = {std::string_view("naive"),
                                              std::string_view("forward_plus"),
                                              std::string_view("clustered_deferred"),
                                              std::string_view("toon_fragment"),
                                              std::string_view("toon_compute")};

// Stage of the deferred renderers' lighting pass.
enum class LightingStage : uint8_t { kCompute, kFragment };
inline constexpr std::array kLightingStageNames = {std::string_view("compute"),
                                                   std::string_view("fragment")};

enum class ToneMap : uint8_t { kPbrNeutral, kClamp };
inline constexpr std::array kToneMapNames = {std::string_view("pbr_neutral"),
                                             std::string_view("clamp")};

enum class Chroma : uint8_t { k420, k444 };
inline constexpr std::array kChromaNames = {std::string_view("420"), std::string_view("444")};

struct Size {
    uint32_t width_px = 1280;
    uint32_t height_px = 720;
    bool operator==(const Size&) const = default;
};

struct GridSize {
    uint32_t x = 16;
    uint32_t y = 9;
    uint32_t z = 24;
    bool operator==(const GridSize&) const = default;
};

struct Lights {
    uint32_t count = 1000;       // seeded point lights
    float radius_m = 2.0F;       // where a light's contribution reaches exactly 0
    float intensity = 1.0F;      // scales every seeded light
    uint32_t seed = 1;
    bool animate = true;         // off: time stands still
    float speed = 1.0F;          // scales the animation's clock
    std::optional<BoundsD3> box; // none: the scene's bounds
    float ambient = 1.0F;        // scales the ambient term
    bool scene_lights = true;    // the scene's own punctual lights
    bool operator==(const Lights&) const = default;
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
    std::array<Point, kMaxPoints> points = {Point{0.00F, 0.00F, 0}, {0.10F, 0.00F, 0},
                                            {0.16F, 0.35F, 0},      {0.45F, 0.35F, 0},
                                            {0.52F, 0.70F, 0},      {0.80F, 0.70F, 0},
                                            {0.86F, 1.00F, 0},      {1.00F, 1.00F, 0}};
    bool operator==(const ToonRamp&) const = default;
};

struct ViewSettings {
    Camera camera;
    Size size;
    Renderer renderer = Renderer::kClusteredDeferred;
    LightingStage lighting = LightingStage::kCompute;
    GridSize grid;
    Lights lights;
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
    bool operator==(const ViewSettings&) const = default;
};

struct Encoding {
    uint32_t quality = 80; // TurboJPEG's 1..100
    Chroma chroma = Chroma::k420;
    bool operator==(const Encoding&) const = default;
};

} // namespace froxel::view
