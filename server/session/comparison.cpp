#include "session/comparison.h"

#include "core/text.h"
#include "session/session_state.h"
#include "settings/value_text.h"

#include <algorithm>

namespace froxel::session {
namespace {

constexpr std::array kShared = {std::string_view("lights"),
                                std::string_view("seed"),
                                std::string_view("light_places"),
                                std::string_view("light_palette"),
                                std::string_view("animate"),
                                std::string_view("light_speed"),
                                std::string_view("scene_lights"),
                                std::string_view("count_pairs"),
                                std::string_view("debug_view"),
                                std::string_view("debug_scale_max"),
                                std::string_view("animation_playing"),
                                std::string_view("animation_speed"),
                                std::string_view("animation_repeat"),
                                std::string_view("animation_fade"),
                                std::string_view("codec"),
                                std::string_view("video_kbps"),
                                std::string_view("adaptive"),
                                std::string_view("target_fps"),
                                std::string_view("refine")};

// Of the same terms, summed in the same order.
constexpr std::array kExact = {std::string_view("light_loop"), std::string_view("grid_law"),
                               std::string_view("lighting")};

// naive and forward_plus are the same but for the lists.
bool isForward(settings::Renderer renderer) {
    return renderer == settings::Renderer::kNaive || renderer == settings::Renderer::kForwardPlus;
}

CommandResult<SettingChange> parseChange(std::string_view text) {
    const size_t colon = text.find(':');
    const std::string_view name = text.substr(0, colon);
    const SessionSetting* setting = findSetting(name);
    if (setting == nullptr) {
        return Rejection{RejectCode::kUnsupported, 0, printable(name),
                         printable(name) + " is not a setting; expected NAME:VALUE"};
    }
    if (!canDiffer(setting->facts())) {
        return outOfRange(std::string(name), "is the same on both sides of a comparison");
    }
    const std::string_view value = colon == std::string_view::npos ? "" : text.substr(colon + 1);
    const auto parsed = settings::parseSetting(setting->facts(), value);
    if (!parsed) {
        return Rejection{RejectCode::kOutOfRange, 0, std::string(name),
                         std::string(name) + ": " + parsed.error().message};
    }
    const auto* choice = std::get_if<settings::Choice>(&*parsed);
    if (name == "antialiasing" && choice != nullptr &&
        static_cast<settings::Antialiasing>(choice->index) == settings::Antialiasing::kMean16) {
        return outOfRange(std::string(name),
                          "is mean16, which one side of a comparison cannot have; choose ssaa4");
    }
    return SettingChange{setting, *parsed};
}

} // namespace

bool canDiffer(const settings::Setting& setting) {
    return setting.kind != settings::SettingKind::kColor &&
           std::ranges::find(kShared, setting.name) == kShared.end();
}

CommandResult<SettingChanges> parseRight(std::string_view text) {
    SettingChanges changes;
    if (text.empty()) {
        return changes;
    }
    for (const std::string_view part : settings::split(text, ',')) {
        const auto change = parseChange(part);
        if (!change) {
            return change.error();
        }
        const std::string_view name = change->setting->facts().name;
        if (givenIn(changes, name) != nullptr) {
            return outOfRange(std::string(name), "is given twice");
        }
        changes.push_back(*change);
    }
    return changes;
}

std::string textOf(const SettingChanges& right) {
    std::string text;
    for (const SettingChange& change : right) {
        const settings::Setting& setting = change.setting->facts();
        text += (text.empty() ? "" : ",") + std::string(setting.name) + ":" +
                settings::addressText(setting, change.value);
    }
    return text;
}

SessionState rightOf(const SessionState& state) {
    SessionState right = state;
    for (const SettingChange& change : state.comparison->right) {
        change.setting->set(right, change.value);
    }
    return right;
}

bool promisesEqualBits(const SessionState& state) {
    const SessionState right = rightOf(state);
    // A list that is cut has the strongest lights of a cluster, by whatever grid.
    const bool capped = state.settings.list_cap > 0 || right.settings.list_cap > 0;
    return !capped &&
           std::ranges::all_of(state.comparison->right, [&](const SettingChange& change) {
               const std::string_view name = change.setting->facts().name;
               return change.value == change.setting->valueIn(state) ||
                      std::ranges::find(kExact, name) != kExact.end() ||
                      (name == "renderer" && isForward(state.settings.renderer) &&
                       isForward(right.settings.renderer));
           });
}

} // namespace froxel::session
