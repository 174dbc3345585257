#include "gltf/document.h"

#include "core/text.h"
#include "gltf/glb_container.h"
#include "gltf/json_check.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace froxel::gltf {
namespace {

using Json = nlohmann::json;

Json takeArray(Json& root, const char* key) {
    const auto found = root.find(key);
    if (found == root.end()) {
        return Json::array();
    }
    Json array = std::move(*found);
    root.erase(found);
    return array;
}

void takeBuffers(Json& root, Document& document) {
    for (const Json& buffer : takeArray(root, "buffers")) {
        document.buffers.push_back({buffer.value("uri", ""), buffer.at("byteLength")});
    }
}

void takeImages(Json& root, Document& document) {
    for (const Json& image : takeArray(root, "images")) {
        document.images.push_back(
            {image.value("name", ""), image.value("uri", ""), image.value("bufferView", -1)});
    }
}

void takeIndices(Json& root, Document& document) {
    const auto meshes = root.find("meshes");
    if (meshes == root.end()) {
        return;
    }
    for (Json& mesh : *meshes) {
        std::vector<int>& accessors = document.indices.emplace_back();
        for (Json& primitive : mesh.at("primitives")) {
            const Json indices = primitive.value("indices", Json(-1));
            if (!indices.is_number()) {
                fail(thing("mesh", document.indices.size() - 1) + " " +
                     thing("primitive", accessors.size()) +
                     " has an object as indices; right is an accessor's number");
            }
            accessors.push_back(indices.get<int>());
            primitive.erase("indices");
        }
    }
}

void takeMotion(Json& root, Warnings& warnings) {
    if (const size_t count = takeArray(root, "animations").size(); count > 0) {
        warnings.add(std::to_string(count) + " animations are not played; the nodes keep their "
                                             "rest pose");
    }
    if (const size_t count = takeArray(root, "skins").size(); count > 0) {
        warnings.add(std::to_string(count) + " skins are not applied; skinned meshes keep their "
                                             "rest pose");
    }
}

// tinygltf's messages are lines; the first says what is wrong.
std::string firstLine(const std::string& text) {
    return printable(text.substr(0, text.find('\n')), 300);
}

} // namespace

Document readDocument(SceneFolder& folder, Warnings& warnings) {
    Document document;
    document.file = folder.readSceneFile();
    std::span<const std::byte> text = document.file;
    if (isGlb(document.file)) {
        const GlbChunks chunks = splitGlb(document.file);
        text = chunks.json;
        document.binary_chunk = chunks.binary;
    }
    Json root = parseJson(text);
    checkJson(root, warnings);
    takeBuffers(root, document);
    takeImages(root, document);
    takeIndices(root, document);
    takeMotion(root, warnings);

    const std::string clean = root.dump();
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, clean.c_str(),
                                                   static_cast<unsigned>(clean.size()), "");
    // It also drops single things that it cannot read, saying so only here.
    if (!parsed || !error.empty()) {
        fail("it is no glTF 2.0 file: " + firstLine(error));
    }
    if (document.indices.size() != document.model.meshes.size()) {
        fail("it is no glTF 2.0 file: a mesh cannot be read");
    }
    return document;
}

} // namespace froxel::gltf
