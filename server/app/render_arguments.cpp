#include "app/render_arguments.h"

#include "app/setting_options.h"
#include "core/assert.h"
#include "core/text.h"
#include "settings/setting_rows.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cctype>
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

std::string textOf(const settings::Size& size) {
    return fmt::format("{}x{}", size.width_px, size.height_px);
}

std::string textOf(const BoundsD3& box) {
    return textOf(box.min) + ";" + textOf(box.max);
}

std::string textOf(const settings::Grid& grid) {
    return grid.automatic ? "auto" : fmt::format("{}x{}x{}", grid.size.x, grid.size.y, grid.size.z);
}

class Arguments {
  public:
    void always(const std::string& option, const std::string& value) {
        texts_.insert(texts_.end(), {option, value});
    }
    // Where it is not as in a run without the option.
    template <class T>
    void changed(const char* option, const T& value, const T& usual) {
        if (value != usual) {
            always(option, textOf(value));
        }
    }
    void flag(const std::string& option) { texts_.push_back(option); }
    [[nodiscard]] std::vector<std::string>& texts() { return texts_; }

  private:
    std::vector<std::string> texts_;
};

// Told even at their defaults: what people look for first, and what would go by the scene.
bool isTold(const settings::Setting& setting) {
    static constexpr std::array kTold = {
        std::string_view("renderer"),      std::string_view("lights"),
        std::string_view("light_radius"),  std::string_view("light_intensity"),
        std::string_view("exposure_mode"), std::string_view("environment")};
    return std::ranges::find(kTold, setting.name) != kTold.end();
}

void addSettings(Arguments& arguments, const settings::ViewSettings& settings) {
    const settings::ViewSettings usual;
    for (const auto& row : settings::kSettingRows) {
        const settings::SettingValue value = row.get(settings);
        const settings::SettingValue usual_value = row.get(usual);
        if (value == usual_value && !isTold(row)) {
            continue;
        }
        const std::string option = optionName(row, usual_value);
        if (row.kind == settings::SettingKind::kSwitch) {
            arguments.flag(option);
        } else {
            arguments.always(option, settings::textOf(row, value));
        }
    }
    arguments.changed("--grid", settings.grid, settings::Grid{true, {}, settings.grid.law});
    if (settings.lights.box) {
        arguments.always("--light-box", textOf(*settings.lights.box));
    }
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
    for (const auto& [name, choice] :
         {std::pair("--animation", &options.choices.animation),
          std::pair("--material-variant", &options.choices.material_variant)}) {
        if (!choice->empty()) {
            arguments.always(name, *choice);
        }
    }
    if (!options.environment_file.empty()) {
        arguments.always("--environment-file", options.environment_file.string());
    }
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
    arguments.always("--look", "none"); // all that it would set is said
    addSettings(arguments, settings);
    if (!options.light_set.empty()) {
        arguments.always("--light-set", options.light_set.string());
    }
    arguments.changed("--time", options.time_s, usual.time_s);
    arguments.always("--frames", numberText(options.frame_count));
    arguments.changed("--warmup", options.warmup_count, usual.warmup_count);
    if (options.keep_surfaces) {
        arguments.texts().emplace_back("--keep-surfaces");
    }
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
