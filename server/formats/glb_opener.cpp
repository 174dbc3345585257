#include "formats/glb_opener.h"

#include "core/scene_file.h"
#include "formats/glb_of_model.h"
#include "formats/obj_file.h"
#include "formats/ply_file.h"
#include "formats/stl_file.h"
#include "formats/three_mf_file.h"
#include "gltf/limits.h"
#include "gltf/scene_files.h"

#include <algorithm>
#include <array>

namespace froxel::formats {

namespace {

// `memory_of_byte`: what reading takes at most for each byte of a file, with the GLB: measured 56
// for OBJ files of short faces, 5 for STL; counted for PLY polygons of text. Of 3MF it is what the
// zip itself takes: what it unpacks to is held by the process's own limit.
struct Format {
    std::string_view ending;
    uint64_t memory_of_byte;
    const char* assumed; // what is told of its unit and its axis; null: the file says them
};
constexpr std::array<Format, 4> kFormats = {{
    {".obj", 60, "OBJ has no unit and no axis: it is read in metres, with y up"},
    {".ply", 80, "PLY has no unit and no axis: it is read in metres, with y up"},
    {".stl", 8, "STL has no unit and no axis: it is read in millimetres, with z up"},
    {".3mf", 8, nullptr},
}};

// Null: it is glTF.
const Format* formatOf(const std::filesystem::path& file) {
    const auto* const found =
        std::ranges::find(kFormats, std::string_view(lowerCaseEnding(file)), &Format::ending);
    return found == kFormats.end() ? nullptr : found;
}

void checkMemory(uint64_t file_bytes, const Format& format, uint64_t memory_bytes) {
    const uint64_t most_bytes = std::min(gltf::kMaxFileBytes, memory_bytes / format.memory_of_byte);
    if (file_bytes > most_bytes) {
        gltf::fail("it has " + std::to_string(file_bytes) +
                   " bytes; a file of this format may have " + std::to_string(most_bytes) +
                   " here");
    }
}

} // namespace

bool GlbOpener::isConverted(const std::filesystem::path& file) {
    return formatOf(file) != nullptr;
}

gltf::OpenedFile GlbOpener::openScene() {
    const Format& format = *formatOf(file_);
    const gltf::OpenedFile file = files_.openScene();
    checkMemory(file.size_bytes, format, memory_bytes_);
    gltf::OpenedFile made;
    made.shown = file.shown;
    made.bytes = glbOf(readModel(format.ending, gltf::readAll(file, "the scene")));
    made.size_bytes = made.bytes.size();
    if (format.assumed != nullptr) {
        warnings_.add(warning::kAssumed, "", format.assumed);
    }
    return made;
}

Model GlbOpener::readModel(std::string_view ending, const std::vector<std::byte>& bytes) {
    if (ending == ".obj") {
        return readObj(
            bytes, [this](const std::string& path) { return openBeside(path); }, warnings_);
    }
    if (ending == ".ply") {
        return readPly(bytes);
    }
    return ending == ".stl" ? readStl(bytes) : readThreeMf(bytes, warnings_);
}

std::optional<std::vector<std::byte>> GlbOpener::openBeside(const std::string& path) {
    try {
        const gltf::OpenedFile file = files_.open(path, "mtllib");
        checkMemory(file.size_bytes, *formatOf(file_), memory_bytes_);
        return gltf::readAll(file, "mtllib");
    } catch (const gltf::Unusable& unusable) {
        warnings_.add(unusable.kind(), "", unusable.what());
        return {};
    }
}

} // namespace froxel::formats
