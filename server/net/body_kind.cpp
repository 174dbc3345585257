#include "net/body_kind.h"

#include "core/binary_stl.h"

#include <algorithm>
#include <array>
#include <span>

namespace froxel::net {

namespace {

constexpr std::string_view kBlank = " \t\r\n";

bool isBinaryStl(std::string_view begin, uint64_t size_bytes) {
    const auto bytes = std::as_bytes(std::span(begin));
    return bytes.size() >= binary_stl::kHeaderBytes && size_bytes == binary_stl::sizeBytes(bytes);
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
