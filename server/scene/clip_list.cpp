#include "core/text.h"
#include "scene/motion.h"

namespace froxel::scene {

std::string listOf(const std::vector<Clip>& clips) {
    constexpr size_t kMostBytes = 400;
    std::string list;
    for (size_t i = 0; i < clips.size() && list.size() <= kMostBytes; ++i) {
        const std::string name = clips[i].name.empty() ? "(nameless)" : printable(clips[i].name);
        list += (list.empty() ? "" : ", ") + numberText(i + 1) + " " + name;
    }
    return list.empty() ? "none" : printable(list, kMostBytes);
}

} // namespace froxel::scene
