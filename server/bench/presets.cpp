#include "bench/presets.h"

#include "bench/rows.h"
#include "bench/tradeoffs.h"
#include "core/assert.h"
#include "core/text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace froxel::bench {

namespace {

using settings::LightingStage;
using settings::Renderer;

Sweep lightCount(const Base& base) {
    constexpr std::array kCounts = {0U,      1U,       10U,      100U,     500U,
                                    1'000U,  2'500U,   5'000U,   10'000U,  25'000U,
                                    50'000U, 100'000U, 250'000U, 500'000U, 1'000'000U};
    Sweep sweep{"light_count",
                "Frame time against the number of lights",
                "lights",
                "",
                Axis::kLog,
                "The radius is constant, so more lights overlap more.",
                {}};
    for (const auto& way : kWays) {
        for (const uint32_t count : kCounts) {
            sweep.rows.push_back(rowOf(base, way, grouped(count) + " lights", count,
                                       [&](auto& s) { s.lights.count = count; }));
        }
    }
    return sweep;
}

Sweep lightRadius(const Base& base) {
    constexpr std::array kRadii = {0.25F, 0.5F, 1.0F, 2.0F, 5.0F, 10.0F, 20.0F, 50.0F};
    Sweep sweep{"light_radius",
                "Frame time against the lights' radius",
                "radius",
                "m",
                Axis::kLog,
                fmt::format("{} lights.", grouped(base.settings.lights.count)),
                {}};
    for (const auto& way : kWays) {
        for (const float radius : kRadii) {
            sweep.rows.push_back(rowOf(base, way, numberText(radius) + " m",
                                       static_cast<double>(radius),
                                       [&](auto& s) { s.lights.radius_m = radius; }));
        }
    }
    return sweep;
}

Sweep resolution(const Base& base) {
    constexpr std::array kSizes = {settings::Size{640, 360},   settings::Size{960, 540},
                                   settings::Size{1280, 720},  settings::Size{1920, 1080},
                                   settings::Size{2560, 1440}, settings::Size{3840, 2160}};
    Sweep sweep{"resolution",
                "Frame time against resolution",
                "pixels",
                "px",
                Axis::kLog,
                fmt::format("{} lights.", grouped(base.settings.lights.count)),
                {}};
    for (const auto& way : kWays) {
        for (const auto& size : kSizes) {
            sweep.rows.push_back(rowOf(base, way, nameOf(size),
                                       static_cast<double>(size.width_px) * size.height_px,
                                       [&](auto& s) { s.size = size; }));
        }
    }
    return sweep;
}

// The seeds' grids, finer ones, and the one chosen by the cost model.
Sweep grid(const Base& base) {
    constexpr std::array kGrids = {settings::GridSize{1, 1, 1},    settings::GridSize{8, 8, 16},
                                   settings::GridSize{16, 16, 8},  settings::GridSize{16, 9, 24},
                                   settings::GridSize{15, 15, 15}, settings::GridSize{16, 16, 16},
                                   settings::GridSize{16, 16, 24}, settings::GridSize{32, 16, 16},
                                   settings::GridSize{32, 16, 32}, settings::GridSize{32, 32, 16},
                                   settings::GridSize{32, 16, 64}, settings::GridSize{32, 32, 32},
                                   settings::GridSize{28, 28, 42}, settings::GridSize{32, 32, 64},
                                   settings::GridSize{64, 36, 32}, settings::GridSize{128, 72, 64}};
    Sweep sweep{"grid",     "Frame time against the grid",
                "clusters", "",
                Axis::kLog, "Lists are always used. The automatic grid is at 0.",
                {}};
    for (const auto& way : kListWays) {
        sweep.rows.push_back(rowOf(base, way, "auto", 0, [](auto& s) {
            s.grid.automatic = true;
            s.light_loop = settings::LightLoop::kLists;
        }));
        for (const auto& size : kGrids) {
            sweep.rows.push_back(rowOf(base, way, fmt::format("{}x{}x{}", size.x, size.y, size.z),
                                       static_cast<double>(size.x) * size.y * size.z, [&](auto& s) {
                                           s.grid.automatic = false;
                                           s.grid.size = size;
                                           s.light_loop = settings::LightLoop::kLists;
                                       }));
        }
    }
    return sweep;
}

Sweep shading(const Base& base) {
    Sweep sweep{"shading",
                "Shading models",
                "model",
                "",
                Axis::kCategory,
                "Metallic-roughness, its diffuse part alone, and Blinn's highlight.",
                {}};
    for (const auto& way : kWays) {
        for (const auto model :
             {settings::ShadingModel::kLambert, settings::ShadingModel::kBlinnPhong,
              settings::ShadingModel::kPbr}) {
            sweep.rows.push_back(rowOf(base, way, nameOf(settings::kShadingModelNames, model),
                                       static_cast<double>(model),
                                       [&](auto& s) { s.shading = model; }));
        }
    }
    return sweep;
}

Sweep materialVariants(const Base& base) {
    Sweep sweep{"material_variants",
                "Material variants of the scene",
                "variant",
                "",
                Axis::kCategory,
                "The surfaces' own materials, and those of each variant.",
                {}};
    for (const auto& way : kWays) {
        for (uint32_t number = 0; number <= base.material_variants.size(); ++number) {
            sweep.rows.push_back(rowOf(base, way,
                                       number == 0 ? "none" : base.material_variants[number - 1],
                                       number, [&](auto& s) { s.material_variant = number; }));
        }
    }
    return sweep;
}

// Rows of one row a way, told apart by it.
Sweep byWay(Sweep sweep, const Base& base, std::span<const Way> ways) {
    for (const auto& way : ways) {
        sweep.rows.push_back(rowOf(base, way, nameOf(way), static_cast<double>(sweep.rows.size())));
    }
    return sweep;
}

constexpr std::array kStages = {LightingStage::kCompute, LightingStage::kFragment};

Sweep toon(const Base& base) {
    std::vector<Way> ways;
    for (const auto stage : kStages) {
        ways.push_back({Renderer::kClusteredDeferred, stage});
        ways.push_back({Renderer::kToonFragment, stage});
        ways.push_back({Renderer::kToonCompute, stage});
    }
    return byWay({"toon",
                  "Both toon variants by pass",
                  "renderer",
                  "",
                  Axis::kCategory,
                  "Compared with the same renderer without a ramp.",
                  {}},
                 base, ways);
}

Sweep renderer(const Base& base) {
    std::vector<Way> ways;
    for (size_t name = 0; name < settings::kRendererNames.size(); ++name) {
        for (const auto stage : kStages) {
            ways.push_back({static_cast<Renderer>(name), stage});
        }
    }
    return byWay({"renderer",
                  "Every renderer, lights added up in either stage",
                  "renderer",
                  "",
                  Axis::kCategory,
                  "By pass.",
                  {}},
                 base, ways);
}

Sweep cameraPath(const Base& base) {
    Sweep sweep{"view",          "Frame time along the camera path", "view", "",
                Axis::kCategory, "Every view of the path.",          {}};
    for (const auto& way : kListWays) {
        for (size_t stop = 0; stop < base.views.size(); ++stop) {
            auto row = rowOf(base, way, "", static_cast<double>(stop),
                             [&](auto& s) { s.camera = base.views[stop].camera; });
            row.only_view = stop;
            row.label = fmt::format("stop {}", stop + 1);
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

// A viewer who looks: the camera rests, lights move.
Sweep rest(const Base& base) {
    Sweep sweep{"rest",
                "A still camera before moving lights",
                "surfaces",
                "",
                Axis::kCategory,
                "Surfaces are drawn in each frame, or reused as serve does.",
                {}};
    for (const auto& way : kWays) {
        for (const bool keep : {false, true}) {
            auto row = rowOf(base, way, keep ? "kept" : "drawn anew", keep ? 1 : 0);
            row.keep_surfaces = keep;
            sweep.rows.push_back(std::move(row));
        }
    }
    return sweep;
}

// What it takes to bring the picture to the host.
Sweep form(const Base& base) {
    using settings::Chroma;
    using settings::Codec;
    using settings::Encoding;
    Sweep sweep{"form",
                "Forms in which pictures come to the host",
                "form",
                "",
                Axis::kCategory,
                "The camera rests, and lights move. Look at the passes readback, planes and jpeg.",
                {}};
    const std::array<std::pair<const char*, std::optional<Encoding>>, 7> forms = {
        {{"pixels", std::nullopt},
         {"planes, 4:2:0", Encoding{.codec = Codec::kVp9}},
         {"planes, 4:4:4", Encoding{.chroma = Chroma::k444, .codec = Codec::kVp9}},
         {"jpeg 50", Encoding{.quality = 50}},
         {"jpeg 85", Encoding{.quality = 85}},
         {"jpeg 97", Encoding{.quality = 97}},
         {"jpeg 85, 4:4:4", Encoding{.quality = 85, .chroma = Chroma::k444}}}};
    for (size_t i = 0; i < forms.size(); ++i) {
        auto row = rowOf(base, kDeferred, forms[i].first, static_cast<double>(i));
        row.keep_surfaces = true;
        row.form = forms[i].second;
        sweep.rows.push_back(std::move(row));
    }
    return sweep;
}

Sweep memory(const Base& base) {
    struct Load {
        settings::Size size;
        uint32_t light_count;
    };
    constexpr std::array kLoads = {Load{{640, 360}, 1'000}, Load{{1280, 720}, 1'000},
                                   Load{{1280, 720}, 10'000}, Load{{1920, 1080}, 10'000},
                                   Load{{3840, 2160}, 10'000}};
    Sweep sweep{"memory",        "Device memory by purpose", "load", "",
                Axis::kCategory, "Look at memory_bytes.",    {}};
    for (const auto& way : kWays) {
        double place = 0;
        for (const auto& load : kLoads) {
            sweep.rows.push_back(
                rowOf(base, way, nameOf(load.size) + ", " + grouped(load.light_count) + " lights",
                      place, [&](auto& s) {
                          s.size = load.size;
                          s.lights.count = load.light_count;
                      }));
            ++place;
        }
    }
    return sweep;
}

// What each debug view costs, beside the picture itself.
Sweep debugViews(const Base& base) {
    Sweep sweep{"debug_view",
                "Debug views",
                "view",
                "",
                Axis::kCategory,
                "Most of them replace the lighting.",
                {}};
    for (size_t view = 0; view < settings::kDebugViewNames.size(); ++view) {
        sweep.rows.push_back(rowOf(base, kDeferred, std::string(settings::kDebugViewNames[view]),
                                   static_cast<double>(view), [&](auto& s) {
                                       s.debug.view = static_cast<settings::DebugView>(view);
                                       if (s.debug.view == settings::DebugView::kGbufferExtra) {
                                           s.gbuffer.position = settings::PositionSource::kFp32;
                                       }
                                   }));
    }
    return sweep;
}

struct Preset {
    std::string_view name;
    Sweep (*make)(const Base&);
};
constexpr std::array kPresets = {
    Preset{"light_count", lightCount},
    Preset{"light_radius", lightRadius},
    Preset{"resolution", resolution},
    Preset{"grid", grid},
    Preset{"gbuffer", gbufferSweep},
    Preset{"shading", shading},
    Preset{"toon", toon},
    Preset{"renderer", renderer},
    Preset{"view", cameraPath},
    Preset{"rest", rest},
    Preset{"form", form},
    Preset{"memory", memory},
    Preset{"debug_view", debugViews},
    Preset{"resolution_scale", resolutionScaleSweep},
    Preset{"cutoff", cutoffSweep},
    Preset{"compensation", compensationSweep},
    Preset{"list_cap", listCapSweep},
    Preset{"bloom", bloomSweep},
    Preset{"antialiasing", antialiasingSweep},
    Preset{"transparency", transparencySweep},
    Preset{"fog", fogSweep},
    Preset{"shadows", shadowSweep},
    Preset{"area_lights", areaSweep},
    Preset{"environment", environmentSweep},
    Preset{"stream", streamSweep},
    Preset{"geometry_error", geometryErrorSweep},
    Preset{"material_variants", materialVariants},
    Preset{"smoke", smokeSweep},
};
constexpr auto kPresetNames = [] {
    std::array<std::string_view, kPresets.size()> names;
    std::ranges::transform(kPresets, names.begin(), &Preset::name);
    return names;
}();

} // namespace

std::span<const std::string_view> presetNames() {
    return kPresetNames;
}

std::span<const std::string_view> fullPresetNames() {
    constexpr size_t kByNameAlone =
        3; // few scenes are so large or have variants, and smoke measures nothing
    return std::span(kPresetNames).first(kPresetNames.size() - kByNameAlone);
}

Sweep makeSweep(std::string_view name, const Base& base) {
    FROXEL_ASSERT(!base.views.empty(), "a sweep needs a view");
    const auto preset = std::ranges::find(kPresets, name, &Preset::name);
    FROXEL_ASSERT(preset != kPresets.end(), "no such preset");
    return preset->make(base);
}

} // namespace froxel::bench
