// What the address of a still asks for: see docs/guide/stills.md. Pure; any thread.
#pragma once

#include "net/http_site.h"
#include "still/named_views.h"
#include "still/still_desk.h"

#include <boost/url/url_view.hpp>

#include <string_view>
#include <variant>
#include <vector>

namespace froxel::net {

struct StillFormat {
    std::string_view name;
    settings::Codec codec;
    std::string_view content_type;
    bool facts = false; // about the picture, not the picture
    bool sheets = true; // whether several views may be one of it
};

struct WantedStill {
    still::StillRequest still;
    const StillFormat* format = nullptr;        // never null
    std::vector<const still::NamedView*> views; // none: one still, of the view that it says

    // Whether it takes more than a still.
    [[nodiscard]] bool isSeries() const { return !views.empty(); }
};

// The scene's own first view at this size.
[[nodiscard]] WantedStill thumbnailOf(std::string_view scene, const settings::Size& size);

// Not a WantedStill: why it is refused. `brings_scene`: the scene comes with the request.
[[nodiscard]] std::variant<WantedStill, Response>
readStillAddress(const boost::urls::url_view& target, bool brings_scene);

} // namespace froxel::net
