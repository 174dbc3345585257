#include "gltf/document.h"

#include "core/text.h"
#include "core/unwind_reserve.h"
#include "gltf/glb_container.h"
#include "gltf/json_check.h"

#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

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

// Of an extension of the whole file.
Json takeExtensionArray(Json& root, const char* extension, const char* key) {
    const Json::json_pointer place(std::string("/extensions/") + extension);
    return root.contains(place) && root.at(place).is_object() ? takeArray(root.at(place), key)
                                                              : Json::array();
}

void takeBuffers(Json& root, Document& document) {
    for (const Json& buffer : takeArray(root, "buffers")) {
        document.buffers.push_back(
            {buffer.value("uri", ""), buffer.value("byteLength", uint64_t{0})});
    }
}

void takeImages(Json& root, Document& document) {
    for (const Json& image : takeArray(root, "images")) {
        document.images.push_back({image.value("name", ""), image.value("uri", ""),
                                   image.value("mimeType", ""), image.value("bufferView", -1)});
    }
}

void takeStrides(Json& root, Document& document, Warnings& warnings) {
    const auto views = root.find("bufferViews");
    if (views == root.end()) {
        return;
    }
    for (Json& view : *views) {
        const size_t stride = view.value("byteStride", size_t{0});
        if (stride % 4 != 0 || stride > 252) {
            const size_t index = document.strides.size();
            warnings.add(warning::kByteStride, pointerTo("bufferViews", index) + "/byteStride",
                         thing("bufferView", index) + " has byteStride " + std::to_string(stride) +
                             "; expected a multiple of 4 up to 252");
        }
        document.strides.push_back(stride);
        view.erase("byteStride");
    }
}

// Bytes are copied out, so any address will do here; it may not elsewhere.
void checkAlignment(const tinygltf::Model& model, Warnings& warnings) {
    for (size_t i = 0; i < model.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = model.accessors[i];
        const auto view = static_cast<size_t>(accessor.bufferView);
        const int size =
            tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
        if (accessor.bufferView < 0 || view >= model.bufferViews.size() || size <= 0) {
            continue;
        }
        const size_t offset = model.bufferViews[view].byteOffset + accessor.byteOffset;
        if (offset % static_cast<size_t>(size) != 0) {
            warnings.add(warning::kAlignment, pointerTo("accessors", i),
                         thing("accessor", i) + " begins at byte " + std::to_string(offset) +
                             " of its buffer; expected a multiple of " + std::to_string(size));
        }
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
                     " has an object as indices; expected an accessor's number");
            }
            accessors.push_back(indices.get<int>());
            primitive.erase("indices");
        }
    }
}

void takeSkins(Json& root, Document& document) {
    for (const Json& skin : takeArray(root, "skins")) {
        document.skins.push_back({skin.value("name", ""), skin.value("joints", std::vector<int>()),
                                  skin.value("inverseBindMatrices", -1)});
    }
}

void takeClips(Json& root, Document& document, Warnings& warnings) {
    const Json none = Json::array();
    for (const Json& animation : takeArray(root, "animations")) {
        ClipSource& clip = document.clips.emplace_back();
        clip.name = animation.value("name", "");
        for (const Json& sampler : animation.value("samplers", none)) {
            clip.samplers.push_back({sampler.value("input", -1), sampler.value("output", -1),
                                     sampler.value("interpolation", "LINEAR")});
        }
        for (const Json& channel : animation.value("channels", none)) {
            Json target = channel.value("target", Json::object());
            if (!target.is_object()) { // a number is right, but of a buffer view
                const std::string pointer = pointerTo("animations", document.clips.size() - 1) +
                                            pointerTo("channels", clip.channels.size()) + "/target";
                warnings.add(warning::kType, pointer,
                             pointer + " is a number and has no effect; expected an object");
                target = Json::object();
            }
            clip.channels.push_back(
                {channel.value("sampler", -1), target.value("node", -1), target.value("path", "")});
        }
    }
}

void takeCameras(Json& root, Document& document) {
    for (const Json& camera : takeArray(root, "cameras")) {
        const std::string type = camera.value("type", "");
        const bool is_flat = type == "orthographic";
        const Json lens = camera.value(is_flat ? "orthographic" : "perspective", Json::object());
        document.cameras.push_back({camera.value("name", ""), type,
                                    lens.value(is_flat ? "ymag" : "yfov", 0.0),
                                    lens.value("znear", 0.0)});
    }
}

void takeLights(Json& root, Document& document) {
    for (const Json& light : takeExtensionArray(root, "KHR_lights_punctual", "lights")) {
        const Json spot = light.value("spot", Json::object());
        document.lights.push_back({light.value("name", ""), light.value("type", ""),
                                   light.value("color", std::vector<double>()),
                                   light.value("intensity", 1.0), light.value("range", 0.0),
                                   spot.value("innerConeAngle", 0.0),
                                   spot.value("outerConeAngle", glm::quarter_pi<double>())});
    }
}

// tinygltf would drop those without a name, and so renumber the others.
void takeMaterialVariants(Json& root, Document& document, Warnings& warnings) {
    const std::string place = "/extensions/KHR_materials_variants/variants";
    const Json variants = takeExtensionArray(root, "KHR_materials_variants", "variants");
    const size_t count = std::min(variants.size(), kMaxChoices);
    tellTooMany("material variants", variants.size() - count, warnings);
    for (size_t i = 0; i < count; ++i) {
        const Json& variant = variants[i];
        auto& names = document.material_variants;
        if (!variant.is_object()) {
            warnings.add(warning::kType, place,
                         place + "/" + std::to_string(names.size()) + " is " + variant.dump() +
                             "; expected an object; it is one without a name");
        }
        names.push_back(variant.is_object() ? variant.value("name", "") : "");
    }
}

// tinygltf refuses the whole file for one of these.
void dropTexturesWithoutIndex(Json& value, const std::string& pointer, Warnings& warnings) {
    for (auto it = value.begin(); it != value.end();) {
        const bool is_slot = it->is_object() && it.key().ends_with("Texture");
        const std::string place = pointer + "/" + it.key();
        if (is_slot && !it->contains("index")) {
            warnings.add(warning::kNoIndex, place,
                         place + " has no index of a texture, which is required; it is left out");
            it = value.erase(it);
            continue;
        }
        if (it->is_object()) {
            dropTexturesWithoutIndex(*it, place, warnings);
        }
        ++it;
    }
}

void mendMaterials(Json& root, Warnings& warnings) {
    const auto materials = root.find("materials");
    for (size_t i = 0; materials != root.end() && i < materials->size(); ++i) {
        dropTexturesWithoutIndex((*materials)[i], pointerTo("materials", i), warnings);
    }
}

void checkByteOrderMark(std::span<const std::byte> text, Warnings& warnings) {
    constexpr std::byte kMark[] = {std::byte{0xEF}, std::byte{0xBB}, std::byte{0xBF}};
    if (text.size() >= std::size(kMark) &&
        std::equal(std::begin(kMark), std::end(kMark), text.begin())) {
        warnings.add(warning::kByteOrderMark, "",
                     "the JSON text begins with a byte order mark, which glTF does not allow");
    }
}

// tinygltf's messages are lines; the first says what is wrong.
std::string firstLine(const std::string& text) {
    return printable(text.substr(0, text.find('\n')), 300);
}

// That of the arrays' elements, as tinygltf will keep them.
void takeMemory(const Json& root, ReadMemory& memory) {
    for (const auto& [key, value] : root.items()) {
        const uint64_t each = key == "materials" ? kMaterialBytes : kElementBytes;
        memory.take(value.is_array() ? value.size() * each : 0, "/" + printable(key));
    }
    if (const auto meshes = root.find("meshes"); meshes != root.end()) {
        for (const Json& mesh : *meshes) {
            memory.take(mesh.at("primitives").size() * kPrimitiveBytes, "/meshes");
        }
    }
}

} // namespace

Document readDocument(SceneFiles& files, ReadMemory& memory, Warnings& warnings) {
    Document document;
    document.file = files.readSceneFile();
    std::span<const std::byte> text = document.file;
    if (isGlb(document.file)) {
        const GlbChunks chunks = splitGlb(document.file, warnings);
        text = chunks.json;
        document.binary_chunk = chunks.binary;
    }
    checkByteOrderMark(text, warnings); // the parser skips it
    const size_t value_count = countValues(text, memory);
    Json root;
    // What follows frees it first, and then the tree, whose destructor lists all of its values.
    const UnwindReserve reserve(value_count * 3 * sizeof(Json));
    root = parseJson(text);
    checkJson(root, warnings);
    document.extensions = extensionsOf(root);
    takeMemory(root, memory);
    takeBuffers(root, document);
    takeImages(root, document);
    takeStrides(root, document, warnings);
    takeIndices(root, document);
    takeSkins(root, document);
    takeClips(root, document, warnings);
    takeCameras(root, document);
    takeLights(root, document);
    takeMaterialVariants(root, document, warnings);
    mendMaterials(root, warnings);

    const std::string clean = root.dump();
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, clean.c_str(),
                                                   static_cast<unsigned>(clean.size()), "");
    // It also drops single things that it cannot read, saying so only here.
    if (!parsed || !error.empty()) {
        fail("it is not a glTF 2.0 file: " + firstLine(error));
    }
    if (document.indices.size() != document.model.meshes.size()) {
        fail("it is not a glTF 2.0 file: a mesh cannot be read");
    }
    checkAlignment(document.model, warnings);
    return document;
}

} // namespace froxel::gltf
