#include "scene/name_list.h"

#include "core/text.h"

namespace froxel::scene {

std::string numberedList(const std::vector<std::string>& names) {
    constexpr size_t kMostBytes = 400;
    std::string list;
    for (size_t i = 0; i < names.size() && list.size() <= kMostBytes; ++i) {
        const std::string name = names[i].empty() ? "(nameless)" : printable(names[i]);
        list += (list.empty() ? "" : ", ") + numberText(i + 1) + " " + name;
    }
    return list.empty() ? "none" : printable(list, kMostBytes);
}

} // namespace froxel::scene
