#include "bench/tradeoffs.h"

#include "bench/rows.h"
#include "core/text.h"
#include "settings/ranges.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace froxel::bench {

namespace {

// Every normal encoding with positions from depth, every position source with the default normal,
// and what the seeds store.
std::vector<settings::GbufferLayout> gbufferLayouts() {
    std::vector<settings::GbufferLayout> layouts;
    for (size_t normal = 0; normal < settings::kNormalEncodingNames.size(); ++normal) {
        layouts.push_back(
            {static_cast<settings::NormalEncoding>(normal), settings::PositionSource::kDepth});
    }
    for (size_t position = 1; position < settings::kPositionSourceNames.size(); ++position) {
        layouts.push_back(
            {settings::NormalEncoding::kOct16, static_cast<settings::PositionSource>(position)});
    }
    layouts.push_back({settings::NormalEncoding::kXyz16, settings::PositionSource::kFp16});
    return layouts;
}

settings::Size scaledBy(const settings::Size& size, double scale) {
    const auto side = [scale](uint32_t whole) {
        return static_cast<uint32_t>(static_cast<double>(whole) * scale + 0.5);
    };
    return {std::max(side(size.width_px), settings::kWidthRange.min),
            std::max(side(size.height_px), settings::kHeightRange.min)};
}

} // namespace

Sweep gbufferSweep(const Base& base) {
    Sweep sweep{"gbuffer",
                "G-buffer layouts",
                "layout",
                "",
                Axis::kCategory,
                "Normals and positions stored with less precision, or in other layouts.",
                {}};
    for (const auto& layout : gbufferLayouts()) {
        const auto label = nameOf(settings::kNormalEncodingNames, layout.normal) + ", " +
                           nameOf(settings::kPositionSourceNames, layout.position);
        sweep.rows.push_back(rowOf(base, kDeferred, label, static_cast<double>(sweep.rows.size()),
                                   [&](auto& s) { s.gbuffer = layout; }));
    }
    return sweep;
}

Sweep geometryErrorSweep(const Base& base) {
    Sweep sweep{"geometry_error",
                "Coarser levels of meshes",
                "error",
                "px",
                Axis::kLinear,
                "R2 is the full model, drawn by the device in the same way.",
                {}};
    for (const float error_px : {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.0F}) {
        auto row =
            rowOf(base, kDeferred, numberText(error_px) + " px", static_cast<double>(error_px),
                  [&](auto& s) { s.geometry_error_px = error_px; });
        row.against = Against::kFullModel;
        sweep.rows.push_back(std::move(row));
    }
    return sweep;
}

Sweep resolutionScaleSweep(const Base& base) {
    struct Scale {
        const char* label;
        double value;
    };
    Sweep sweep{"resolution_scale",
                "Drawn smaller and scaled up",
                "scale",
                "",
                Axis::kLinear,
                "Scaled bilinearly, like the page's canvas.",
                {}};
    for (const auto& [label, value] : {Scale{"1/2", 0.5}, Scale{"3/4", 0.75}, Scale{"1", 1.0}}) {
        auto row = rowOf(base, kDeferred, label, value,
                         [scale = value](auto& s) { s.size = scaledBy(s.size, scale); });
        row.scaled_to = base.settings.size;
        sweep.rows.push_back(std::move(row));
    }
    return sweep;
}

Sweep cutoffSweep(const Base& base) {
    constexpr std::array kCutoffs = {1.0F,  0.5F,  0.2F,   0.1F,   0.05F,
                                     0.02F, 0.01F, 0.005F, 0.002F, 0.0F};
    Sweep sweep{"cutoff",   "Lights cut off early",
                "cutoff",   "",
                Axis::kLog, "A light ends where its irradiance would fall to this.",
                {}};
    for (const auto& way : kListWays) {
        for (const float value : kCutoffs) {
            sweep.rows.push_back(rowOf(base, way, "cutoff " + numberText(value),
                                       static_cast<double>(value),
                                       [&](auto& s) { s.lights.cutoff = value; }));
        }
    }
    return sweep;
}

Sweep compensationSweep(const Base& base) {
    Sweep sweep{"compensation",
                "Lights cut off early, with compensation",
                "cutoff",
                "",
                Axis::kLog,
                "A light that ends early is brightened by the light that it lost, or not.",
                {}};
    for (const bool compensated : {false, true}) {
        for (const float value : {0.2F, 0.1F, 0.05F, 0.02F, 0.01F}) {
            auto row = rowOf(base, kDeferred, "cutoff " + numberText(value),
                             static_cast<double>(value), [&](auto& s) {
                                 s.lights.cutoff = value;
                                 s.lights.cutoff_compensated = compensated;
                             });
            row.series = compensated ? "given back" : "lost";
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

Sweep listCapSweep(const Base& base) {
    Sweep sweep{"list_cap", "Lists capped by importance",
                "cap",      "lights",
                Axis::kLog, "R1 is the error of the cap, compared with the picture of every light.",
                {}};
    for (const auto& way : kListWays) {
        for (const uint32_t cap : {4U, 8U, 16U, 32U, 64U, 128U, 256U}) {
            sweep.rows.push_back(rowOf(base, way, fmt::format("cap {}", cap), cap, [&](auto& s) {
                s.list_cap = cap;
                s.light_loop = settings::LightLoop::kLists;
            }));
        }
    }
    return sweep;
}

Sweep bloomSweep(const Base& base) {
    Sweep sweep{
        "bloom", "Ways of bloom", "kind",
        "",      Axis::kCategory, "R2 is the Gaussian that each method approximates, in double.",
        {}};
    for (size_t kind = 0; kind < settings::kBloomKindNames.size(); ++kind) {
        const auto value = static_cast<settings::BloomKind>(kind);
        sweep.rows.push_back(rowOf(base, kDeferred, nameOf(settings::kBloomKindNames, value),
                                   static_cast<double>(kind),
                                   [&](auto& s) { s.bloom.kind = value; }));
    }
    return sweep;
}

Sweep antialiasingSweep(const Base& base) {
    Sweep sweep{"antialiasing",
                "Antialiasing",
                "kind",
                "",
                Axis::kCategory,
                "R2 is the mean of 64 samples for each pixel. fxaa affects only the displayed "
                "picture. mean16 draws 16 frames; its times are those of one frame.",
                {}};
    for (size_t kind = 0; kind < settings::kAntialiasingNames.size(); ++kind) {
        const auto value = static_cast<settings::Antialiasing>(kind);
        auto row = rowOf(base, kDeferred, nameOf(settings::kAntialiasingNames, value),
                         static_cast<double>(kind), [&](auto& s) { s.antialiasing = value; });
        row.against = Against::kSamples;
        sweep.rows.push_back(std::move(row));
    }
    return sweep;
}

Sweep transparencySweep(const Base& base) {
    Sweep sweep{
        "transparency",
        "Ways of transparency",
        "kind",
        "",
        Axis::kCategory,
        "R2 is up to 16 layers peeled by the device. For the built-in scene use --camera Glass.",
        {}};
    const auto add = [&](settings::Transparency kind, std::optional<uint32_t> layers) {
        auto label = nameOf(settings::kTransparencyNames, kind);
        label += layers ? fmt::format(", {} layers", *layers) : "";
        auto row =
            rowOf(base, kDeferred, label, static_cast<double>(sweep.rows.size()), [&](auto& s) {
                s.transparency = kind;
                s.peel_layers = layers.value_or(s.peel_layers);
            });
        row.against = Against::kPeeled;
        sweep.rows.push_back(std::move(row));
    };
    add(settings::Transparency::kSorted, std::nullopt);
    add(settings::Transparency::kWeighted, std::nullopt);
    for (const uint32_t layers : {1U, 2U, 4U, 8U, 16U}) {
        add(settings::Transparency::kPeeled, layers);
    }
    return sweep;
}

Sweep fogSweep(const Base& base) {
    struct Volume {
        uint32_t tile_px;
        uint32_t slice_count;
    };
    Sweep sweep{"fog",
                "Fog by volumes",
                "volume",
                "",
                Axis::kCategory,
                "R2 integrates lights along each ray, in double. Compare each row with the one "
                "without fog.",
                {}};
    const auto add = [&](const std::string& label, const settings::Fog& fog) {
        sweep.rows.push_back(rowOf(base, kDeferred, label, static_cast<double>(sweep.rows.size()),
                                   [&](auto& s) { s.fog = fog; }));
    };
    settings::Fog fog;
    add("none", fog);
    fog.density = 0.05F;
    fog.anisotropy = 0.4F;
    for (const auto& [tile_px, slice_count] :
         {Volume{64, 16}, Volume{32, 32}, Volume{16, 32}, Volume{16, 64}, Volume{16, 128},
          Volume{8, 64}, Volume{8, 128}}) {
        fog.tile_px = tile_px;
        fog.slice_count = slice_count;
        add(fmt::format("{} px, {} slices", tile_px, slice_count), fog);
    }
    fog = {.density = 0.05F, .anisotropy = 0.4F};
    fog.half_rate = true;
    add("16 px, 64 slices, half rate", fog);
    fog.half_rate = false;
    fog.noise = true;
    add("16 px, 64 slices, noise", fog);
    fog.noise = false;
    fog.height_falloff = 0.5F;
    add("16 px, 64 slices, by height", fog);
    return sweep;
}

Sweep shadowSweep(const Base& base) {
    Sweep sweep{"shadows",
                "Lights with shadow maps",
                "lights",
                "",
                Axis::kLinear,
                "R2 traces rays to the lights. Differences are at the edges of shadows.",
                {}};
    for (const uint32_t size_px : {128U, 256U, 512U}) {
        for (const uint32_t count : {0U, 1U, 4U, 16U, 32U}) {
            auto row = rowOf(base, kDeferred, fmt::format("{} lights of {}", count, size_px), count,
                             [&](auto& s) {
                                 s.shadows = {count, size_px};
                             });
            row.series = fmt::format("{} pixels a side", size_px);
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

// Ahead of the path's first stop, shining down.
std::vector<settings::PlacedLight> areaLights(const settings::Camera& camera, uint32_t count) {
    std::vector<settings::PlacedLight> lights;
    const glm::dmat3& axes = camera.world_from_view;
    for (uint32_t i = 0; i < count; ++i) {
        settings::PlacedLight light;
        light.id = i + 1;
        light.kind = settings::LightKind::kArea;
        light.position_world = camera.eye_world - axes[2] * (2.0 + i / 3) +
                               axes[0] * (i % 3 - 1.0) * 1.5 + axes[1] * 0.75;
        light.width_m = 1;
        light.height_m = 0.25;
        light.radius_m = 5;
        light.intensity = 2;
        lights.push_back(light);
    }
    return lights;
}

Sweep areaSweep(const Base& base) {
    Sweep sweep{
        "area_lights",
        "Rectangular area lights beside other lights",
        "lights",
        "",
        Axis::kLinear,
        "R2 sums over the parts of each rectangle. The difference is the fit of the highlight.",
        {}};
    for (const auto shading : {settings::ShadingModel::kPbr, settings::ShadingModel::kLambert}) {
        for (const uint32_t count : {0U, 1U, 4U, 16U}) {
            auto row =
                rowOf(base, kDeferred, fmt::format("{} area lights", count), count, [&](auto& s) {
                    s.shading = shading;
                    s.lights.placed =
                        settings::PlacedLights(areaLights(base.views.front().camera, count));
                });
            row.series = nameOf(settings::kShadingModelNames, shading);
            if (count > 0) {
                row.light_set = fmt::format("area_lights_{}.json", count);
            }
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

Sweep environmentSweep(const Base& base) {
    Sweep sweep{
        "environment",
        "Light from around",
        "light",
        "",
        Axis::kCategory,
        "R2 is the same approximation in double; environment_error measures the approximation.",
        {}};
    for (const auto shading : {settings::ShadingModel::kPbr, settings::ShadingModel::kLambert}) {
        for (const auto light :
             {settings::EnvironmentLight::kOff, settings::EnvironmentLight::kStudio}) {
            auto row = rowOf(base, kDeferred, nameOf(settings::kEnvironmentLightNames, light),
                             static_cast<double>(light), [&](auto& s) {
                                 s.shading = shading;
                                 s.environment.light = light;
                             });
            row.series = nameOf(settings::kShadingModelNames, shading);
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

Sweep streamSweep(const Base& base) {
    Sweep sweep{"stream",
                "Error of the stream's JPEG",
                "quality",
                "",
                Axis::kLinear,
                "The decoded picture compared with the original.",
                {}};
    for (const auto chroma : {settings::Chroma::k420, settings::Chroma::k444}) {
        for (const uint32_t quality : {30U, 50U, 70U, 80U, 90U, 95U}) {
            const auto name = nameOf(settings::kChromaNames, chroma);
            auto row =
                rowOf(base, kDeferred, fmt::format("quality {}, {}", quality, name), quality);
            row.series = name;
            row.stream = settings::Encoding{quality, chroma};
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

Sweep smokeSweep(const Base& base) {
    auto small = base;
    small.settings.size = {96, 54};
    small.settings.lights.count = 30;
    Sweep sweep{"smoke", "A try of everything", "row",
                "",      Axis::kCategory,       "Too small for meaningful results.",
                {}};
    const auto add = [&](Row row) {
        row.value = static_cast<double>(sweep.rows.size());
        sweep.rows.push_back(std::move(row));
    };
    for (const auto& way : {kNaive, kForwardPlus, kDeferred}) {
        add(rowOf(small, way, nameOf(way), 0));
    }
    for (const auto toon_renderer :
         {settings::Renderer::kToonFragment, settings::Renderer::kToonCompute}) {
        const Way way{toon_renderer, settings::LightingStage::kAuto};
        add(rowOf(small, way, nameOf(way), 0));
    }
    add(rowOf(small, kDeferred, "oct8", 0,
              [](auto& s) { s.gbuffer.normal = settings::NormalEncoding::kOct8; }));
    add(rowOf(small, kDeferred, "bloom", 0,
              [](auto& s) { s.bloom.kind = settings::BloomKind::kMipChain; }));
    add(rowOf(small, kDeferred, "metered", 0,
              [](auto& s) { s.exposure_mode = settings::ExposureMode::kFrame; }));
    add(rowOf(small, kDeferred, "fog", 0, [](auto& s) { s.fog.density = 0.05F; }));
    add(rowOf(small, kDeferred, "studio", 0,
              [](auto& s) { s.environment.light = settings::EnvironmentLight::kStudio; }));
    auto smooth = rowOf(small, kDeferred, "ssaa4", 0,
                        [](auto& s) { s.antialiasing = settings::Antialiasing::kSsaa4; });
    smooth.against = Against::kSamples;
    add(std::move(smooth));
    auto half = rowOf(small, kDeferred, "1/2", 0, [](auto& s) { s.size = scaledBy(s.size, 0.5); });
    half.scaled_to = small.settings.size;
    add(std::move(half));
    auto jpeg = rowOf(small, kDeferred, "JPEG", 0);
    jpeg.stream = settings::Encoding{};
    add(std::move(jpeg));
    return sweep;
}

} // namespace froxel::bench
