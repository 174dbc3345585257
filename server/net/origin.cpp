#include "net/origin.h"

#include <boost/beast/core/string.hpp>

#include <algorithm>

namespace froxel::net {

using boost::beast::iequals;

bool originAllowed(std::optional<std::string_view> origin,
                   std::string_view host,
                   bool secure,
                   std::span<const std::string> allowed) {
    if (!origin) {
        return true;
    }
    if (std::any_of(allowed.begin(), allowed.end(),
                    [&](const std::string& listed) { return iequals(*origin, listed); })) {
        return true;
    }
    for (const std::string_view scheme : {"https://", "http://"}) {
        if (secure && scheme == "http://") {
            continue;
        }
        if (!host.empty() && origin->size() == scheme.size() + host.size() &&
            iequals(origin->substr(0, scheme.size()), scheme) &&
            iequals(origin->substr(scheme.size()), host)) {
            return true;
        }
    }
    return false;
}

} // namespace froxel::net
