#include "gltf_writer/glb_writer.h"

#include "gltf_writer/binary_buffer.h"
#include "gltf_writer/glb_frame.h"
#include "gltf_writer/material_json.h"
#include "gltf_writer/node_json.h"
#include "gltf_writer/png_image.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>

namespace froxel::gltf_writer {
namespace {

constexpr const char* kVariantsExtension = "KHR_materials_variants";

// Adds `value` under `key` unless it is empty: glTF forbids empty arrays.
void addArray(Json& root, const char* key, Json value) {
    if (!value.empty()) {
        root[key] = std::move(value);
    }
}

Result<void> addPrimitive(const scene::Primitive& primitive,
                          const std::string& mesh,
                          BinaryBuffer& buffer,
                          Json& primitives) {
    if (primitive.indices.empty()) {
        return Error{ErrorCode::kScene, "mesh '" + mesh + "' has a part without triangles"};
    }
    if (primitive.uv0.empty() && !primitive.uv1.empty()) {
        return Error{ErrorCode::kScene,
                     "mesh '" + mesh + "' has a second set of texture coordinates without a first"};
    }
    for (const glm::vec3& position : primitive.positions) {
        if (!std::isfinite(position.x) || !std::isfinite(position.y) ||
            !std::isfinite(position.z)) {
            return Error{ErrorCode::kScene,
                         "mesh '" + mesh + "' has a position that is not finite"};
        }
    }
    Json attributes = {{"POSITION", buffer.addVectors(primitive.positions, true)},
                       {"NORMAL", buffer.addVectors(primitive.normals)}};
    if (!primitive.tangents.empty()) {
        attributes["TANGENT"] = buffer.addVectors(primitive.tangents);
    }
    if (!primitive.uv0.empty()) {
        attributes["TEXCOORD_0"] = buffer.addVectors(primitive.uv0);
    }
    if (!primitive.uv1.empty()) {
        attributes["TEXCOORD_1"] = buffer.addVectors(primitive.uv1);
    }
    if (!primitive.colors.empty()) {
        attributes["COLOR_0"] = buffer.addVectors(primitive.colors);
    }
    Json json = {{"attributes", std::move(attributes)},
                 {"indices", buffer.addIndices(primitive.indices, primitive.positions.size())},
                 {"material", primitive.material}};
    for (const scene::VariantMaterial& of : primitive.variant_materials) {
        json["extensions"][kVariantsExtension]["mappings"].push_back(
            {{"material", of.material}, {"variants", Json::array({of.variant})}});
    }
    primitives.push_back(std::move(json));
    return {};
}

// Builds the document; the buffer fills on the way.
class Document {
  public:
    Result<void> add(const scene::Scene& scene) {
        if (auto result = addImages(scene); result.has_error()) {
            return result;
        }
        if (auto result = addMeshes(scene); result.has_error()) {
            return result;
        }
        return addNodes(scene);
    }

    [[nodiscard]] std::string json(const scene::Scene& scene) {
        Json root = {{"asset", {{"version", "2.0"}, {"generator", "froxel"}}}};
        Json samplers = Json::array();
        Json textures = Json::array();
        Json materials = Json::array();
        for (const scene::Sampler& sampler : scene.samplers) {
            samplers.push_back(samplerJson(sampler));
        }
        for (const scene::Texture& texture : scene.textures) {
            textures.push_back(textureJson(texture));
        }
        for (const scene::Material& material : scene.materials) {
            materials.push_back(materialJson(material, extensions_));
        }
        for (const std::string& name : scene.material_variants) {
            extensions_.insert(kVariantsExtension);
            root["extensions"][kVariantsExtension]["variants"].push_back({{"name", name}});
        }
        if (!lights_.empty()) {
            extensions_.insert(kLightsExtension);
            root["extensions"][kLightsExtension]["lights"] = lights_;
        }
        addArray(root, "extensionsUsed", Json(extensions_));
        Json top = Json::object();
        if (!scene.name.empty()) {
            top["name"] = scene.name;
        }
        Json roots = Json::array();
        for (size_t i = 0; i < nodes_.size(); ++i) {
            roots.push_back(i);
        }
        addArray(top, "nodes", std::move(roots));
        root["scene"] = 0;
        root["scenes"] = Json::array({std::move(top)});
        addArray(root, "nodes", std::move(nodes_));
        addArray(root, "cameras", std::move(cameras_));
        addArray(root, "meshes", std::move(meshes_));
        addArray(root, "materials", std::move(materials));
        addArray(root, "textures", std::move(textures));
        addArray(root, "samplers", std::move(samplers));
        addArray(root, "images", std::move(images_));
        addArray(root, "accessors", buffer_.accessors());
        addArray(root, "bufferViews", buffer_.views());
        if (!buffer_.bytes().empty()) {
            root["buffers"] = Json::array({{{"byteLength", buffer_.bytes().size()}}});
        }
        return root.dump();
    }

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return buffer_.bytes(); }

  private:
    Result<void> addImages(const scene::Scene& scene) {
        for (const scene::Image& image : scene.images) {
            const auto png = pngImage(image);
            if (png.has_error()) {
                return png.error();
            }
            Json json = {{"bufferView", buffer_.addBytes(*png)}, {"mimeType", "image/png"}};
            if (!image.name.empty()) {
                json["name"] = image.name;
            }
            images_.push_back(std::move(json));
        }
        return {};
    }

    Result<void> addMeshes(const scene::Scene& scene) {
        for (const scene::Mesh& mesh : scene.meshes) {
            if (mesh.primitives.empty()) {
                return Error{ErrorCode::kScene, "mesh '" + mesh.name + "' has no triangles"};
            }
            Json primitives = Json::array();
            for (const scene::Primitive& primitive : mesh.primitives) {
                if (auto result = addPrimitive(primitive, mesh.name, buffer_, primitives);
                    result.has_error()) {
                    return result;
                }
            }
            Json json = {{"primitives", std::move(primitives)}};
            if (!mesh.name.empty()) {
                json["name"] = mesh.name;
            }
            meshes_.push_back(std::move(json));
        }
        return {};
    }

    Result<void> addNodes(const scene::Scene& scene) {
        for (const scene::Instance& instance : scene.instances) {
            if (auto result = addInstanceNode(instance, nodes_); result.has_error()) {
                return result;
            }
        }
        for (const scene::NamedCamera& camera : scene.cameras) {
            nodes_.push_back(cameraNode(camera, static_cast<uint32_t>(cameras_.size())));
            cameras_.push_back(cameraJson(camera, scene.bounds_world));
        }
        for (const scene::PunctualLight& light : scene.lights) {
            nodes_.push_back(lightNode(light, static_cast<uint32_t>(lights_.size())));
            lights_.push_back(lightJson(light));
        }
        return {};
    }

    BinaryBuffer buffer_;
    Json images_ = Json::array();
    Json meshes_ = Json::array();
    Json nodes_ = Json::array();
    Json cameras_ = Json::array();
    Json lights_ = Json::array();
    std::set<std::string> extensions_;
};

void write(std::ofstream& file, std::span<const std::byte> bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

} // namespace

Result<void> writeGlb(const scene::Scene& scene, const std::filesystem::path& path) {
    Document document;
    if (auto result = document.add(scene); result.has_error()) {
        return result;
    }
    std::string json;
    try {
        json = document.json(scene);
    } catch (const Json::type_error&) { // only dump() throws it, for text that is not UTF-8
        return Error{ErrorCode::kScene, path.string() + ": a name in the scene is not UTF-8 text"};
    }
    const std::vector<std::byte>& bytes = document.bytes();
    const auto frame = glbFrame(std::move(json), bytes.size());
    if (!frame) {
        return Error{frame.error().code, path.string() + ": the scene " + frame.error().message};
    }
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    const bool opened = file.is_open();
    write(file, frame->before);
    write(file, bytes);
    constexpr std::array<std::byte, 3> kZeros{};
    write(file, std::span(kZeros).first(frame->total_bytes - frame->before.size() - bytes.size()));
    file.close();
    if (!file) {
        const std::string reason = errno != 0 ? std::strerror(errno) : "input/output error";
        if (opened) {
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
        }
        return Error{ErrorCode::kIo, path.string() + ": cannot be written: " + reason};
    }
    return {};
}

} // namespace froxel::gltf_writer
