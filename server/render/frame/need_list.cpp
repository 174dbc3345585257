#include "render/frame/need_list.h"

namespace froxel::render {

namespace {

// A device may round a buffer up to this much.
constexpr uint64_t kBufferStep = 256;

} // namespace

void NeedList::buffer(const std::string& purpose, uint64_t bytes) {
    if (bytes > 0) {
        uses.push_back({purpose, (bytes + kBufferStep - 1) / kBufferStep * kBufferStep});
    }
}

} // namespace froxel::render
