#include "light/seeded_lights.h"

#include "core/parallel.h"
#include "light/falloff.h"
#include "light/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace froxel::light {
namespace {

// Lights are worked on in batches that stay in the first-level cache, one array for each quantity,
// so that the compiler can use vector instructions.
constexpr size_t kBatch = 128;

constexpr size_t kColors = 256; // of a palette

// Of a light that hovers at a surface, in its radii: the side of the box that it moves in, and how
// far the middle of that is from the surface.
constexpr double kHoverBox = 0.3;
constexpr double kHoverAbove = 0.25;
// Of the speed that it has elsewhere: turning back every second would look hectic.
constexpr double kHoverPace = 0.25;

// Starting a thread costs about as much as a few thousand lights.
constexpr size_t kLightsPerThread = 32'768;

// Luminance evened out halfway (by the square root): blue of red's full luminance would look like a
// flare, unevened it would be lost.
glm::vec3 evened(const glm::dvec3& color) {
    const double luminance = luminanceOf(color);
    return glm::vec3(color * std::sqrt(0.5 / luminance));
}

// Linear RGB of a hue in [0, 1), saturation 0.85.
glm::vec3 hueColor(double hue) {
    const auto channel = [hue](double shift) {
        const double turn = hue + shift - std::floor(hue + shift);
        return 0.15 + 0.85 * std::clamp(std::abs(turn * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    };
    const glm::dvec3 color(channel(0), channel(2.0 / 3.0), channel(1.0 / 3.0));
    return evened(color);
}

// Linear RGB of a black body from 1667 to 25,000 K, its strongest channel 1. Chromaticity: Kim et
// al. 2002, "Design of Advanced Color Temperature Control System for HDTV Applications".
glm::dvec3 blackBody(double kelvin) {
    const double t = 1e3 / kelvin;
    const double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                   : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
    double y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    if (kelvin < 2222) {
        y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
    } else if (kelvin < 4000) {
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
    }
    const glm::dvec3 xyz(x / y, 1, (1 - x - y) / y);
    const glm::dmat3 rgb_from_xyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108,
                                  -0.2040259, -0.4985314, 0.0415560, 1.0572252); // columns; D65
    const glm::dvec3 color = glm::max(rgb_from_xyz * xyz, glm::dvec3(0));
    return color / std::max({color.x, color.y, color.z});
}

// Evenly spaced by the reciprocal of the temperature, as eyes tell temperatures apart.
glm::vec3 bodyColor(double warmest_k, double coolest_k, double share) {
    return evened(blackBody(1 / glm::mix(1 / warmest_k, 1 / coolest_k, share)));
}

glm::vec3 paletteColor(settings::LightPalette palette, double share) {
    switch (palette) {
    case settings::LightPalette::kRainbow:
        return hueColor(share);
    case settings::LightPalette::kWarm:
        return bodyColor(1'800, 3'000, share);
    case settings::LightPalette::kWhite:
        return bodyColor(4'500, 7'500, share);
    case settings::LightPalette::kCool:
        break;
    }
    return bodyColor(10'000, 25'000, share);
}

using Palette = std::array<glm::vec3, kColors>;

const Palette& colorsOf(settings::LightPalette palette) {
    static const auto tables = [] {
        std::array<Palette, settings::kLightPaletteNames.size()> all{};
        for (size_t p = 0; p < all.size(); ++p) {
            for (size_t i = 0; i < kColors; ++i) {
                all[p][i] = paletteColor(static_cast<settings::LightPalette>(p),
                                         static_cast<double>(i) / kColors);
            }
        }
        return all;
    }();
    return tables[static_cast<size_t>(palette)];
}

// Distance of x to the nearest whole number, times two: a triangle wave in [0, 1]. Adding and
// subtracting 1.5 * 2^52 rounds to a whole number for |x| < 2^51 without a call; beyond, where a
// period is below a micrometre, the phase is lost but the light still stays in its box.
double triangleWave(double x) {
    constexpr double kRounder = 6755399441055744.0;
    return std::min(1.0, 2.0 * std::abs(x - ((x + kRounder) - kRounder)));
}

// What every light's formula shares.
struct SeededFrame {
    glm::dvec3 origin; // of the box, in view space
    glm::dmat3 view_from_box;
    std::span<const LightPlace> places; // that have a box each; empty: one for all
    glm::dmat3 view_from_world;
    glm::dvec3 eye_world;
    double above_m;    // from a place's surface to the middle of its box
    glm::dvec3 cycles; // per-axis waves at unit speed
    float intensity;
    uint64_t key;
    const Palette& colors;
};

SeededFrame seededFrame(const settings::Lights& settings,
                        const settings::Camera& camera,
                        const SeededSpace& space,
                        double time_s) {
    const glm::dmat3 view_from_world = glm::transpose(camera.world_from_view);
    const auto radius = static_cast<double>(settings.radius_m);
    const bool placed = space.places != nullptr && !space.places->empty();
    const glm::dvec3 extent = placed ? glm::dvec3(kHoverBox * radius) : space.box_world.size();
    const glm::dvec3 origin =
        view_from_world * (placed ? -0.5 * extent : space.box_world.min - camera.eye_world);
    const glm::dmat3 view_from_box(view_from_world[0] * extent.x, view_from_world[1] * extent.y,
                                   view_from_world[2] * extent.z);
    // Per-axis speeds are 1/sqrt(3) of the overall ones. A period is twice the box; a flat box
    // stands still on that axis.
    const double travel_s = placed ? kHoverPace * time_s : time_s;
    glm::dvec3 cycles{0};
    for (int axis = 0; axis < 3; ++axis) {
        cycles[axis] = extent[axis] > 0 ? travel_s / (2.0 * std::sqrt(3.0) * extent[axis]) : 0.0;
    }
    return {.origin = origin,
            .view_from_box = view_from_box,
            .places = placed ? std::span(*space.places) : std::span<const LightPlace>(),
            .view_from_world = view_from_world,
            .eye_world = camera.eye_world,
            .above_m = kHoverAbove * radius,
            .cycles = cycles,
            .intensity = settings.intensity,
            .key = mix(uint64_t{settings.seed} + 0x632be59bd9b4e019U),
            .colors = colorsOf(settings.palette)};
}

// Writes lights as the shaders read them.
struct ShaderLights {
    std::span<io::Light> out;
    float inv_radius2;

    void look(size_t index, const glm::vec3& color) const {
        io::Light& light = out[index];
        light.inv_radius2 = inv_radius2;
        light.color = color;
        light.spot = io::kNoSpot;
    }
    void place(size_t index, const glm::dvec3& position) const {
        out[index].position_view = glm::vec3(position);
    }
};

// Writes them unrounded.
struct WorldLights {
    std::span<SeededLight> out;

    void look(size_t index, const glm::vec3& color) const { out[index].color = color; }
    void place(size_t index, const glm::dvec3& position) const {
        out[index].position_world = position;
    }
};

// Writes the only one that is asked for.
struct OneWorldLight {
    SeededLight& out;

    void look(size_t /*index*/, const glm::vec3& color) const { out.color = color; }
    void place(size_t /*index*/, const glm::dvec3& position) const {
        out.position_world = position;
    }
};

// Where the box of a light is whose place is this share of all.
glm::dvec3 originOf(const SeededFrame& frame, double share) {
    const auto count = static_cast<double>(frame.places.size());
    const LightPlace& place = frame.places[static_cast<size_t>(share * count)];
    return frame.origin +
           frame.view_from_world *
               (place.position_world + frame.above_m * place.normal_world - frame.eye_world);
}

// Lights [begin, end) of all.
template <class Lights>
void fillRange(const SeededFrame& frame, size_t begin, size_t end, const Lights& out) {
    std::array<std::array<double, kBatch>, 3> wave;
    std::array<double, kBatch> place{}; // as a share of all
    for (size_t first = begin; first < end; first += kBatch) {
        const size_t count = std::min(kBatch, end - first);
        for (size_t i = 0; i < count; ++i) {
            const uint64_t index = (first + i) * 3U;
            const Fractions phase(mix(frame.key + index));
            const Fractions speed(mix(frame.key + index + 1U));
            const Fractions look(mix(frame.key + index + 2U));
            for (size_t axis = 0; axis < 3; ++axis) {
                const double rate =
                    (0.2 + 1.3 * speed.values[axis]) * frame.cycles[static_cast<int>(axis)];
                wave[axis][i] = phase.values[axis] + rate;
            }
            const auto color = static_cast<size_t>(look.values[0] * kColors);
            const auto gain = static_cast<float>(0.5 + look.values[1]) * frame.intensity;
            out.look(first + i, frame.colors[color] * gain);
            place[i] = look.values[2];
        }
        for (auto& axis : wave) {
            for (double& x : axis) {
                x = triangleWave(x);
            }
        }
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec3 origin =
                frame.places.empty() ? frame.origin : originOf(frame, place[i]);
            out.place(first + i, origin + frame.view_from_box *
                                              glm::dvec3(wave[0][i], wave[1][i], wave[2][i]));
        }
    }
}

} // namespace

float inverseRadius2(double radius_m) {
    // Smaller radii than 1e-15 m would overflow a float; no surface point is that near a light.
    const double radius = std::max(radius_m, 1e-15);
    return static_cast<float>(1.0 / (radius * radius));
}

void fillSeededLights(const settings::Lights& settings,
                      const settings::Camera& camera,
                      const SeededSpace& space,
                      double time_s,
                      size_t begin,
                      size_t end,
                      std::span<io::Light> out) {
    const SeededFrame frame = seededFrame(settings, camera, space, time_s);
    const ShaderLights lights{out, inverseRadius2(static_cast<double>(settings.radius_m))};
    const size_t count = end - begin;
    onThreads(count, threadCount(count, kLightsPerThread),
              [&](size_t /*part*/, size_t first, size_t last) {
                  fillRange(frame, begin + first, begin + last, lights);
              });
}

std::vector<SeededLight>
seededLights(const settings::Lights& settings, const SeededSpace& space, double time_s) {
    std::vector<SeededLight> lights(settings.count);
    const SeededFrame frame = seededFrame(settings, {}, space, time_s); // the world's own axes
    fillRange(frame, 0, lights.size(), WorldLights{lights});
    return lights;
}

SeededLight seededLight(const settings::Lights& settings,
                        const SeededSpace& space,
                        double time_s,
                        uint32_t index) {
    SeededLight light;
    const SeededFrame frame = seededFrame(settings, {}, space, time_s);
    fillRange(frame, index, size_t{index} + 1, OneWorldLight{light});
    return light;
}

} // namespace froxel::light
