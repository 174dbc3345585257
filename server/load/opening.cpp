#include "load/opening.h"

namespace froxel::load {

std::vector<v1::ClientMessage> openingOf(const ViewerOptions& options, v1::ViewState& state) {
    std::vector<v1::ClientMessage> messages;
    if (options.size) {
        *messages.emplace_back().mutable_set_size() = *options.size;
        state.set_width(options.size->width());
        state.set_height(options.size->height());
    }
    if (options.light_count) {
        messages.emplace_back().mutable_set_lights()->set_count(*options.light_count);
        state.set_light_count(*options.light_count);
    }
    if (options.encoding) {
        *messages.emplace_back().mutable_set_encoding() = *options.encoding;
    }
    return messages;
}

} // namespace froxel::load
