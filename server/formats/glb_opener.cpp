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

namespace froxel::formats {

namespace {

// What reading takes at most for each byte of a file, with the GLB: measured 56 for OBJ files of
// short faces, 5 for STL; counted for PLY polygons of text. Of 3MF it is what the zip itself takes:
// what it unpacks to is held by the process's own limit.
uint64_t memoryOfByte(const std::string& ending) {
    return ending == ".obj" ? 60 : ending == ".ply" ? 80 : 8;
}

void checkMemory(uint64_t file_bytes, const std::string& ending, uint64_t memory_bytes) {
    const uint64_t most_bytes = std::min(gltf::kMaxFileBytes, memory_bytes / memoryOfByte(ending));
    if (file_bytes > most_bytes) {
        gltf::fail("it has " + std::to_string(file_bytes) +
                   " bytes; a file of this format may have " + std::to_string(most_bytes) +
                   " here");
    }
}

} // namespace

bool GlbOpener::isConverted(const std::filesystem::path& file) {
    const std::string ending = lowerCaseEnding(file);
    return ending == ".obj" || ending == ".ply" || ending == ".stl" || ending == ".3mf";
}

gltf::OpenedFile GlbOpener::openScene() {
    const gltf::OpenedFile file = files_.openScene();
    checkMemory(file.size_bytes, lowerCaseEnding(file_), memory_bytes_);
    gltf::OpenedFile made;
    made.shown = file.shown;
    made.bytes = glbOf(readModel(gltf::readAll(file, "the scene")));
    made.size_bytes = made.bytes.size();
    return made;
}

Model GlbOpener::readModel(const std::vector<std::byte>& bytes) {
    const std::string ending = lowerCaseEnding(file_);
    if (ending == ".obj") {
        return readObj(
            bytes, [this](const std::string& path) { return openBeside(path); }, warnings_);
    }
    if (ending == ".ply") {
        return readPly(bytes, warnings_);
    }
    return ending == ".stl" ? readStl(bytes, warnings_) : readThreeMf(bytes, warnings_);
}

std::optional<std::vector<std::byte>> GlbOpener::openBeside(const std::string& path) {
    try {
        const gltf::OpenedFile file = files_.open(path, "mtllib");
        checkMemory(file.size_bytes, lowerCaseEnding(file_), memory_bytes_);
        return gltf::readAll(file, "mtllib");
    } catch (const gltf::Unusable& unusable) {
        warnings_.add(unusable.kind(), "", unusable.what());
        return {};
    }
}

} // namespace froxel::formats
