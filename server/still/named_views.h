// The sides that stills show a scene from.
#pragma once

#include "core/math.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::still {

struct NamedView {
    std::string_view name;
    std::optional<glm::dvec3> toward_eye; // from the scene's middle; none: the scene's own camera
};

// glTF: +Y is up, and a thing's front faces +Z. "right" is where the viewer of its front has the
// right hand.
inline constexpr std::array kNamedViews = {
    NamedView{"first", {}},
    NamedView{"iso", glm::dvec3{1, 1, 1}},
    NamedView{"iso-back", glm::dvec3{-1, 1, -1}},
    NamedView{"front", glm::dvec3{0, 0, 1}},
    NamedView{"back", glm::dvec3{0, 0, -1}},
    NamedView{"left", glm::dvec3{-1, 0, 0}},
    NamedView{"right", glm::dvec3{1, 0, 0}},
    NamedView{"top", glm::dvec3{0, 1, 0}},
    NamedView{"bottom", glm::dvec3{0, -1, 0}},
};

// Null: there is none of this name.
[[nodiscard]] constexpr const NamedView* findView(std::string_view name) {
    const auto* const found = std::ranges::find(kNamedViews, name, &NamedView::name);
    return found == kNamedViews.end() ? nullptr : found;
}

// "first, iso, ...", for a message.
[[nodiscard]] inline std::string namesOfViews() {
    std::string names;
    for (const NamedView& view : kNamedViews) {
        names += (names.empty() ? "" : ", ") + std::string(view.name);
    }
    return names;
}

} // namespace froxel::still
