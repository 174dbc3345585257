#include "net/still_address.h"

#include "core/text.h"
#include "settings/value_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

// The first where none is named.
constexpr std::array kFormats{
    StillFormat{"jpg", settings::Codec::kJpeg, "image/jpeg"},
    StillFormat{"png", settings::Codec::kPng, "image/png"},
    StillFormat{"exr", settings::Codec::kExr, "image/x-exr", false, false},
    StillFormat{"pfm", settings::Codec::kPfm, "image/x-portable-floatmap", false, false},
    StillFormat{"json", settings::Codec::kPng, "application/json", true},
};

Response refused(const char* code, std::string_view field, const std::string& text) {
    return apiRefusal(http::status::bad_request,
                      {code, std::string(field), std::string(field) + " " + text});
}

// Not none: why it is refused, here and below.
std::optional<Response> readFormat(std::string_view text, WantedStill& wanted) {
    const auto* const format = std::ranges::find(kFormats, text, &StillFormat::name);
    if (format == kFormats.end()) {
        std::array<std::string_view, kFormats.size()> names;
        std::ranges::transform(kFormats, names.begin(), &StillFormat::name);
        return refused("unsupported", "format",
                       fmt::format("is \"{}\"; it must be {}", printable(std::string(text)),
                                   fmt::join(names, ", ")));
    }
    wanted.format = format;
    wanted.still.codec = format->codec;
    return {};
}

std::optional<Response> readViews(std::string_view text, WantedStill& wanted) {
    for (const auto name : settings::split(text, ',')) {
        const still::NamedView* view = still::findView(name);
        if (view == nullptr) {
            return refused("out_of_range", "views",
                           fmt::format("has \"{}\"; each must be one of {}",
                                       printable(std::string(name)), still::namesOfViews()));
        }
        if (std::ranges::find(wanted.views, view) != wanted.views.end()) {
            return refused("out_of_range", "views", fmt::format("has \"{}\" twice", view->name));
        }
        wanted.views.push_back(view);
    }
    return {};
}

std::optional<Response> readParameter(const std::string& key,
                                      const std::string& value,
                                      bool brings_scene,
                                      WantedStill& wanted) {
    if (key == "format") {
        return readFormat(value, wanted);
    }
    if (key == "views") {
        return readViews(value, wanted);
    }
    if (key != "scene") {
        wanted.still.view.push_back({key, value});
        return {};
    }
    if (brings_scene) {
        return refused("unsupported", "scene",
                       "is given in the address and in the body; expected one of them");
    }
    wanted.still.scene = value;
    return {};
}

bool compares(const WantedStill& wanted) {
    const auto& entries = wanted.still.view;
    const auto compare = std::ranges::find(entries, "compare", &still::Entry::name);
    return compare != entries.end() && !compare->text.empty();
}

} // namespace

WantedStill thumbnailOf(std::string_view scene, const settings::Size& size) {
    WantedStill wanted;
    wanted.format = kFormats.data();
    wanted.still.scene = scene;
    wanted.still.thumbnail = true;
    wanted.still.view = {{"size", fmt::format("{}x{}", size.width_px, size.height_px)}};
    return wanted;
}

std::variant<WantedStill, Response> readStillAddress(const boost::urls::url_view& target,
                                                     bool brings_scene) {
    WantedStill wanted;
    wanted.format = kFormats.data();
    std::set<std::string> given;
    for (const auto& said : target.params()) {
        if (said.key.empty() && !said.has_value) { // nothing between two &
            continue;
        }
        if (!given.insert(said.key).second) {
            return refused("out_of_range", printable(said.key), "is given twice");
        }
        if (auto refusal = readParameter(said.key, said.value, brings_scene, wanted)) {
            return std::move(*refusal);
        }
    }
    if (given.contains("view") && given.contains("views")) {
        return refused("unsupported", "views", "is given together with view; expected one of them");
    }
    if (wanted.isSeries() && !wanted.format->sheets) {
        return refused("unsupported", "views", "fits the formats jpg, png and json alone");
    }
    if (compares(wanted) && (wanted.isSeries() || wanted.format->facts || !wanted.format->sheets)) {
        return refused("unsupported", "compare",
                       "fits one picture of the formats jpg and png alone");
    }
    if (wanted.format->facts && !wanted.isSeries()) {
        const auto& entries = wanted.still.view;
        const auto view = std::ranges::find(entries, "view", &still::Entry::name);
        if (auto refusal = readViews(view == entries.end() ? "first" : view->text, wanted)) {
            return std::move(*refusal);
        }
        std::erase_if(wanted.still.view, [](const auto& entry) { return entry.name == "view"; });
    }
    std::ranges::sort(wanted.still.view, {}, &still::Entry::name); // none stands for another order
    return wanted;
}

} // namespace froxel::net
