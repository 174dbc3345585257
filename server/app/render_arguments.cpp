#include "app/render_arguments.h"

#include "core/assert.h"
#include "core/text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <string_view>
#include <utility>

namespace froxel::app {

namespace {

std::string textOf(const glm::dvec3& v) {
    return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

template <class T>
std::string textOf(T number) {
    return numberText(number);
}

std::string textOf(const view::Size& size) {
    return fmt::format("{}x{}", size.width_px, size.height_px);
}

std::string textOf(const BoundsD3& box) {
    return textOf(box.min) + ";" + textOf(box.max);
}

std::string textOf(const view::Grid& grid) {
    return grid.automatic ? "auto" : fmt::format("{}x{}x{}", grid.size.x, grid.size.y, grid.size.z);
}

class Arguments {
  public:
    void always(const char* option, const std::string& value) {
        texts_.insert(texts_.end(), {option, value});
    }
    // Where it is not as in a run without the option.
    template <class T>
    void changed(const char* option, const T& value, const T& usual) {
        if (value != usual) {
            always(option, textOf(value));
        }
    }
    template <class Enum>
    void changedName(const char* option,
                     std::span<const std::string_view> names,
                     Enum value,
                     Enum usual) {
        if (value != usual) {
            always(option, std::string(names[static_cast<size_t>(value)]));
        }
    }
    void flag(const char* option, bool given) {
        if (given) {
            texts_.emplace_back(option);
        }
    }
    [[nodiscard]] std::vector<std::string>& texts() { return texts_; }

  private:
    std::vector<std::string> texts_;
};

void addShading(Arguments& arguments,
                const view::ViewSettings& settings,
                const view::ViewSettings& usual) {
    arguments.changedName("--lighting", view::kLightingStageNames, settings.lighting,
                          usual.lighting);
    arguments.changedName("--shading", view::kShadingModelNames, settings.shading, usual.shading);
    arguments.changed("--grid", settings.grid, view::Grid{true, {}, settings.grid.law});
    arguments.changedName("--grid-law", view::kGridLawNames, settings.grid.law, usual.grid.law);
    arguments.changedName("--light-loop", view::kLightLoopNames, settings.light_loop,
                          usual.light_loop);
    arguments.changed("--list-cap", settings.list_cap, usual.list_cap);
    arguments.changedName("--gbuffer-normal", view::kNormalEncodingNames, settings.gbuffer.normal,
                          usual.gbuffer.normal);
    arguments.changedName("--gbuffer-position", view::kPositionSourceNames,
                          settings.gbuffer.position, usual.gbuffer.position);
    arguments.changedName("--transparency", view::kTransparencyNames, settings.transparency,
                          usual.transparency);
    arguments.changed("--peel-layers", settings.peel_layers, usual.peel_layers);
    arguments.flag("--count-pairs", settings.count_pairs);
    arguments.changedName("--debug-view", view::kDebugViewNames, settings.debug.view,
                          usual.debug.view);
    arguments.changed("--debug-scale-max", settings.debug.scale_max, usual.debug.scale_max);
}

void addLights(Arguments& arguments, const view::Lights& lights, const view::Lights& usual) {
    arguments.always("--lights", numberText(lights.count));
    arguments.always("--light-radius", numberText(lights.radius_m));
    arguments.changed("--light-intensity", lights.intensity, usual.intensity);
    arguments.changed("--light-cutoff", lights.cutoff, usual.cutoff);
    arguments.flag("--light-cutoff-compensated", lights.cutoff_compensated);
    if (lights.box) {
        arguments.always("--light-box", textOf(*lights.box));
    }
    arguments.changed("--light-speed", lights.speed, usual.speed);
    arguments.changed("--seed", lights.seed, usual.seed);
    arguments.changed("--ambient", lights.ambient, usual.ambient);
    arguments.flag("--no-scene-lights", !lights.scene_lights);
    arguments.flag("--no-animate", !lights.animate);
}

void addFog(Arguments& arguments, const view::Fog& fog, const view::Fog& usual) {
    arguments.changed("--fog-density", fog.density, usual.density);
    arguments.changed("--fog-height-falloff", fog.height_falloff, usual.height_falloff);
    arguments.changed("--fog-base-height", fog.base_height_m, usual.base_height_m);
    arguments.changed("--fog-anisotropy", fog.anisotropy, usual.anisotropy);
    if (fog.albedo != usual.albedo) {
        arguments.always("--fog-albedo", numberText(fog.albedo.x) + "," + numberText(fog.albedo.y) +
                                             "," + numberText(fog.albedo.z));
    }
    arguments.changed("--fog-tile", fog.tile_px, usual.tile_px);
    arguments.changed("--fog-slices", fog.slice_count, usual.slice_count);
    arguments.flag("--fog-half-rate", fog.half_rate);
    arguments.flag("--fog-noise", fog.noise);
}

void addPost(Arguments& arguments,
             const view::ViewSettings& settings,
             const view::ViewSettings& usual) {
    const auto& bloom = settings.bloom;
    arguments.changedName("--bloom", view::kBloomKindNames, bloom.kind, usual.bloom.kind);
    arguments.changed("--bloom-threshold", bloom.threshold, usual.bloom.threshold);
    arguments.changed("--bloom-knee", bloom.knee, usual.bloom.knee);
    arguments.changed("--bloom-strength", bloom.strength, usual.bloom.strength);
    arguments.changed("--bloom-radius", bloom.radius, usual.bloom.radius);
    arguments.changedName("--antialiasing", view::kAntialiasingNames, settings.antialiasing,
                          usual.antialiasing);
    addFog(arguments, settings.fog, usual.fog);
    const auto& shadows = settings.shadows;
    arguments.changed("--shadow-lights", shadows.light_count, usual.shadows.light_count);
    arguments.changed("--shadow-size", shadows.size_px, usual.shadows.size_px);
    const auto& outline = settings.toon_outline;
    arguments.changed("--outline-strength", outline.strength, usual.toon_outline.strength);
    arguments.changed("--outline-width", outline.width, usual.toon_outline.width);
}

bool plainInShell(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:,+@=").find(c) != std::string_view::npos;
}

} // namespace

std::vector<std::string> renderArguments(const RenderOptions& options, const std::string& camera) {
    const RenderOptions usual;
    const auto& settings = options.settings;
    FROXEL_ASSERT(settings.toon_fragment == usual.settings.toon_fragment &&
                      settings.toon_compute == usual.settings.toon_compute,
                  "the command line has no ramps");
    Arguments arguments;
    arguments.texts().emplace_back("render");
    arguments.always("--scene", options.scene);
    arguments.always(
        "--device",
        std::string(gpu::kDeviceChoiceNames[static_cast<size_t>(options.device.choice)]));
    if (!camera.empty()) {
        arguments.always("--camera", camera);
    }
    if (options.lens_shift) {
        arguments.always("--lens-shift", numberText(options.lens_shift->x) + "," +
                                             numberText(options.lens_shift->y));
    }
    arguments.always("--size", textOf(settings.size));
    arguments.always("--renderer",
                     std::string(view::kRendererNames[static_cast<size_t>(settings.renderer)]));
    addShading(arguments, settings, usual.settings);
    addLights(arguments, settings.lights, usual.settings.lights);
    if (!options.light_set.empty()) {
        arguments.always("--light-set", options.light_set.string());
    }
    arguments.changed("--exposure", settings.exposure, usual.settings.exposure);
    arguments.changedName("--tone-map", view::kToneMapNames, settings.tone_map,
                          usual.settings.tone_map);
    addPost(arguments, settings, usual.settings);
    arguments.changed("--time", options.time_s, usual.time_s);
    arguments.always("--frames", numberText(options.frame_count));
    arguments.changed("--warmup", options.warmup_count, usual.warmup_count);
    if (!options.out.empty()) {
        arguments.always("--out", options.out.string());
    }
    if (!options.timings.empty()) {
        arguments.always("--timings", options.timings.string());
    }
    return std::move(arguments.texts());
}

std::string shellCommand(const std::vector<std::string>& arguments) {
    std::string line = "froxel";
    for (const auto& argument : arguments) {
        line += ' ';
        if (!argument.empty() && std::ranges::all_of(argument, plainInShell)) {
            line += argument;
            continue;
        }
        line += '\'';
        for (const char c : argument) {
            line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        }
        line += '\'';
    }
    return line;
}

} // namespace froxel::app
