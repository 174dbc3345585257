#include "still/still_view.h"

#include "core/text.h"
#include "froxel/v1/client.pb.h"
#include "session/command_decode.h"
#include "session/placed_lights.h"
#include "session/proto_vec.h"
#include "session/scene_change.h"
#include "settings/value_text.h"
#include "still/named_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace froxel::still {

using session::RejectCode;
using session::Rejection;
using session::SessionState;

namespace {

// What entries ask for, before it meets a scene.
struct Asked {
    session::SetSettings settings;
    session::SetGrid grid;
    session::SetToon toon;
    session::SetLights lights;
    session::SetAnimation animation;
    session::SetCompare compare;
    std::optional<settings::PlacedLights> placed;
    std::optional<uint32_t> material_variant;
    std::optional<settings::Size> size;
    std::optional<bool> frozen;
    std::optional<glm::dvec3> toward_eye; // of a view that is named
    std::optional<glm::dvec3> eye;
    std::optional<glm::dvec3> target;
    std::optional<glm::dvec3> up;
    std::optional<double> fov_deg;
    std::optional<double> half_height_m;
    std::optional<double> lens_shift_x;
    std::optional<double> lens_shift_y;

    [[nodiscard]] settings::GridSize& gridSize() {
        if (!grid.size) {
            grid.size = settings::GridSize();
        }
        return *grid.size;
    }
    [[nodiscard]] bool movesCamera() const {
        return eye || target || up || fov_deg || half_height_m || lens_shift_x || lens_shift_y;
    }
};

template <class Target, class T>
Result<void> put(Target& target, const Result<T>& value) {
    if (!value) {
        return value.error();
    }
    target = *value;
    return {};
}

// What no row of the settings' table holds.
struct Row {
    std::string_view name;
    Result<void> (*read)(Asked& asked, std::string_view text);
};

constexpr settings::Range<uint32_t> kAnyNumber{"number", 0, UINT32_MAX};

template <auto Member>
Result<void> readPosition(Asked& asked, std::string_view text) {
    return put(asked.*Member, settings::parsePosition(text));
}

template <auto Member, const auto& kRange>
Result<void> readNumber(Asked& asked, std::string_view text) {
    return put(asked.*Member, settings::parseNumber(text, kRange));
}

template <auto Side, const auto& kRange>
Result<void> readGridSide(Asked& asked, std::string_view text) {
    return put(asked.gridSize().*Side, settings::parseNumber(text, kRange));
}

Result<void> readPlaced(Asked& asked, std::string_view text) {
    auto placed = session::parseLightSet(text);
    if (!placed) {
        return Error{ErrorCode::kInvalidArgument, placed.error().message};
    }
    asked.placed = std::move(*placed);
    return {};
}

Result<void> readSize(Asked& asked, std::string_view text) {
    return text.starts_with("auto@") ? Result<void>() : put(asked.size, settings::parseSize(text));
}

Result<void> readCompare(Asked& asked, std::string_view text) {
    auto right = session::parseRight(text);
    if (!right) {
        return Error{ErrorCode::kInvalidArgument, right.error().message};
    }
    asked.compare.right = std::move(*right);
    return {};
}

Result<void> readCompareShow(Asked& asked, std::string_view text) {
    const auto index = settings::parseName(text, session::kCompareShowNames);
    if (!index) {
        return index.error();
    }
    asked.compare.show = static_cast<session::CompareShow>(*index);
    return {};
}

Result<void> readNamedView(Asked& asked, std::string_view text) {
    const NamedView* view = findView(text);
    if (view == nullptr) {
        return Error{ErrorCode::kInvalidArgument,
                     "is \"" + printable(std::string(text)) + "\"; it must be " + namesOfViews()};
    }
    asked.toward_eye = view->toward_eye;
    return {};
}

constexpr std::array kRows{
    Row{"size", readSize},
    Row{"view", readNamedView},
    Row{"eye", readPosition<&Asked::eye>},
    Row{"target", readPosition<&Asked::target>},
    Row{"up", readPosition<&Asked::up>},
    Row{"fov_deg", readNumber<&Asked::fov_deg, settings::kFovRange>},
    Row{"half_height", readNumber<&Asked::half_height_m, settings::kHalfHeightRange>},
    Row{"lens_shift.x", readNumber<&Asked::lens_shift_x, settings::kLensShiftXRange>},
    Row{"lens_shift.y", readNumber<&Asked::lens_shift_y, settings::kLensShiftYRange>},
    Row{"grid.auto",
        [](Asked& asked, auto text) {
            return put(asked.grid.automatic, settings::parseSwitch(text));
        }},
    Row{"grid.x", readGridSide<&settings::GridSize::x, settings::kGridXRange>},
    Row{"grid.y", readGridSide<&settings::GridSize::y, settings::kGridYRange>},
    Row{"grid.z", readGridSide<&settings::GridSize::z, settings::kGridZRange>},
    Row{"animation",
        [](Asked& asked, auto text) {
            return put(asked.animation.number, settings::parseNumber(text, kAnyNumber));
        }},
    Row{"animation_time",
        [](Asked& asked, auto text) {
            return put(asked.animation.time_s, settings::parseNumber(text, settings::kTimeRange));
        }},
    Row{"light_time",
        [](Asked& asked, auto text) {
            return put(asked.lights.time_s, settings::parseNumber(text, settings::kTimeRange));
        }},
    Row{"placed_lights", readPlaced},
    Row{"light_box",
        [](Asked& asked, auto text) { return put(asked.lights.box, settings::parseBox(text)); }},
    Row{"material_variant", readNumber<&Asked::material_variant, kAnyNumber>},
    Row{"compare", readCompare},
    Row{"compare_split",
        [](Asked& asked, auto text) {
            return put(asked.compare.split,
                       settings::parseNumber(text, settings::kCompareSplitRange));
        }},
    Row{"compare_show", readCompareShow},
    Row{"debug_frozen",
        [](Asked& asked, auto text) { return put(asked.frozen, settings::parseSwitch(text)); }},
    Row{"toon_fragment",
        [](Asked& asked, auto text) {
            return put(asked.toon.fragment, settings::parseRamp(text));
        }},
    Row{"toon_compute",
        [](Asked& asked, auto text) { return put(asked.toon.compute, settings::parseRamp(text)); }},
};

Result<void> readSetting(Asked& asked, const session::SessionSetting& row, std::string_view text) {
    const auto value = settings::parseSetting(row.facts(), text);
    if (!value) {
        return value.error();
    }
    asked.settings.changes.push_back({&row, *value});
    return {};
}

std::optional<Rejection> read(Asked& asked, const Entries& entries) {
    for (const auto& [name, text] : entries) {
        if (name == "look") {
            continue;
        }
        const auto* row = std::ranges::find(kRows, name, &Row::name);
        const auto* setting = session::findSetting(name);
        if (!isViewName(name)) {
            return Rejection{RejectCode::kUnsupported, 0, printable(name),
                             printable(name) + " is not a name of the page's address"};
        }
        if (const auto done =
                setting != nullptr ? readSetting(asked, *setting, text) : row->read(asked, text);
            !done) {
            return Rejection{RejectCode::kOutOfRange, 0, name, name + ": " + done.error().message};
        }
    }
    return {};
}

// By names and texts parted by = and &, none of them escaped.
Entries entriesOf(const std::string& address) {
    Entries entries;
    for (const auto part : settings::split(address, '&')) {
        const size_t equals = std::min(part.find('='), part.size() - 1);
        entries.push_back(
            {std::string(part.substr(0, equals)), std::string(part.substr(equals + 1))});
    }
    return entries;
}

std::optional<Rejection>
readLook(Asked& asked, const session::SessionContext& context, const Entries& entries) {
    const auto wanted = std::ranges::find(entries, "look", &Entry::name);
    if (wanted == entries.end()) {
        return {};
    }
    const auto look = std::ranges::find(context.looks, wanted->text, &session::OfferedLook::name);
    if (look != context.looks.end()) {
        return read(asked, entriesOf(look->address));
    }
    std::string names;
    for (const auto& offered : context.looks) {
        names += (names.empty() ? "" : ", ") + offered.name;
    }
    return session::outOfRange("look", "is \"" + printable(wanted->text) + "\"; this server has " +
                                           (names.empty() ? "none" : names));
}

// Refused as a viewer's command of the same numbers.
session::CommandResult<session::CommandMessage> cameraCommand(const Asked& asked,
                                                              const settings::Camera& before) {
    v1::ClientMessage message;
    message.set_seq(1);
    v1::SetCamera& set = *message.mutable_set_camera();
    session::fillVec(*set.mutable_eye(), asked.eye.value_or(before.eye_world));
    session::fillVec(*set.mutable_target(), asked.target.value_or(before.target_world()));
    session::fillVec(*set.mutable_up(), asked.up.value_or(before.world_from_view[1]));
    if (asked.half_height_m) {
        set.set_half_height_m(*asked.half_height_m);
    }
    if (asked.fov_deg) {
        set.set_fov_deg(*asked.fov_deg);
    }
    set.mutable_lens_shift()->set_x(asked.lens_shift_x.value_or(before.lens_shift.x));
    set.mutable_lens_shift()->set_y(asked.lens_shift_y.value_or(before.lens_shift.y));
    const std::string bytes = message.SerializeAsString();
    return session::decodeCommand(std::as_bytes(std::span(bytes)), protocol::WireFormat::kBinary);
}

// In an order in which none undoes another.
std::vector<session::Command> commandsOf(const Asked& asked) {
    std::vector<session::Command> commands;
    if (asked.size) {
        commands.emplace_back(session::SetSize{*asked.size});
    }
    commands.emplace_back(asked.settings);
    session::SetGrid grid = asked.grid;
    if (grid.automatic.value_or(false)) {
        grid.size.reset(); // as the page has it: the sides are told and do not count
    }
    commands.emplace_back(grid);
    commands.emplace_back(asked.toon);
    commands.emplace_back(session::SetLights{{}, asked.lights.box});
    commands.emplace_back(session::SetAnimation{{}, asked.animation.number});
    if (asked.compare.right && !asked.compare.right->empty()) {
        commands.emplace_back(asked.compare);
    }
    if (asked.material_variant) {
        commands.emplace_back(session::SetMaterialVariant{*asked.material_variant});
    }
    return commands;
}

// Nothing moves any more.
void stand(SessionState& state, TimePoint now, double light_time_s) {
    settings::ViewSettings& settings = state.settings;
    settings.lights.animate = false;
    settings.animation.playing = false;
    state.light_clock =
        session::LightClock(now, settings.lights.speed, false).withTime(now, light_time_s);
    const double now_s = SessionState::secondsOf(now);
    state.playback = {state.playback.motion(), settings.animation, now_s}; // no fade is under way
}

} // namespace

bool isViewName(std::string_view name) {
    return name == "look" || std::ranges::find(kRows, name, &Row::name) != kRows.end() ||
           session::findSetting(name) != nullptr;
}

session::CommandResult<SessionState>
viewOf(const session::SharedContext& scene, const Entries& entries, TimePoint now) {
    Asked asked;
    if (auto refused = readLook(asked, *scene, entries)) {
        return *refused;
    }
    if (auto refused = read(asked, entries)) {
        return *refused;
    }
    session::CommandResult<SessionState> state = session::beginOn(scene, now);
    state->decodable.set(); // a codec that the address names is not the still's
    const auto apply = [&](const session::Command& command) {
        if (state) {
            state = session::apply(*state, {{1}, command}, *scene, now);
        }
    };
    for (const session::Command& command : commandsOf(asked)) {
        apply(command);
    }
    if (!state) {
        return state;
    }
    if (asked.placed) {
        state->settings.lights.placed = std::move(*asked.placed);
    }
    stand(*state, now, asked.lights.time_s.value_or(0));
    if (asked.animation.time_s) {
        apply(session::SetAnimation{{}, {}, asked.animation.time_s});
    }
    if (state && asked.toward_eye) {
        state->settings.camera =
            settings::overview(scene->first_view.sphere_world,
                               settings::aspectOf(state->settings.size), *asked.toward_eye);
        state->followed.reset();
    }
    if (state && asked.movesCamera()) {
        const auto camera = cameraCommand(asked, state->cameraAt(now));
        if (!camera) {
            return camera.error();
        }
        apply(camera->body);
    }
    if (asked.frozen) {
        apply(session::SetDebugView{{}, asked.frozen});
    }
    if (state) {
        if (state->comparison) {
            state->comparison->divided = true;
        }
        state->delivery = {.adaptive = false, .target_fps = 0, .refine = settings::Refine::kNone};
    }
    return state;
}

settings::Size smaller(const settings::Size& size, double times) {
    const double side = 1 / std::sqrt(std::max(times, 1.0));
    const auto scaled = [side](uint32_t px, uint32_t least) {
        return std::max(least, static_cast<uint32_t>(px * side));
    };
    return {scaled(size.width_px, settings::kWidthRange.min),
            scaled(size.height_px, settings::kHeightRange.min)};
}

} // namespace froxel::still
