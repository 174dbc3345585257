#include "net/body_kind.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::net {

namespace {

constexpr std::string_view kBlank = " \t\r\n";

// A binary STL file has no mark, but its length tells its number of triangles, which it also has.
bool isBinaryStl(std::string_view begin, uint64_t size_bytes) {
    constexpr size_t kHeaderBytes = 84;
    constexpr uint64_t kTriangleBytes = 50;
    if (begin.size() < kHeaderBytes) {
        return false;
    }
    uint32_t count = 0;
    std::memcpy(&count, begin.data() + kHeaderBytes - sizeof count, sizeof count);
    return size_bytes == kHeaderBytes + count * kTriangleBytes;
}

bool isObjWord(std::string_view word) {
    constexpr std::array<std::string_view, 10> kWords = {"v", "vt", "vn",     "vp",     "o",
                                                         "g", "s",  "mtllib", "usemtl", "f"};
    return word.starts_with('#') || std::ranges::find(kWords, word) != kWords.end();
}

} // namespace

std::optional<std::string_view> sceneNameOf(std::string_view begin, uint64_t size_bytes) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (begin.starts_with("glTF")) {
        return "scene.glb";
    }
    if (begin.starts_with("PK\x03\x04")) {
        return "scene.3mf";
    }
    std::string_view text = begin;
    text.remove_prefix(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    if (text.starts_with('{')) {
        return "scene.gltf";
    }
    if (begin.size() < std::min<uint64_t>(kMostOfKind, size_bytes)) {
        return {};
    }
    const std::string_view word = text.substr(0, text.find_first_of(kBlank));
    if (word == "ply") {
        return "scene.ply";
    }
    if (isBinaryStl(begin, size_bytes) || word == "solid") {
        return "scene.stl";
    }
    return isObjWord(word) ? "scene.obj" : "";
}

} // namespace froxel::net
