#include "formats/glb_of_model.h"

#include "core/text.h"
#include "gltf_writer/binary_buffer.h"
#include "gltf_writer/glb_frame.h"

#include <Poco/URI.h>
#include <numeric>
#include <set>
#include <string>

namespace froxel::formats {

namespace {

using gltf_writer::BinaryBuffer;
using Json = gltf_writer::Json;

constexpr const char* kTransformExtension = "KHR_texture_transform";
constexpr int kClampToEdge = 33071;

// Images, each with its sampler, as textures of the file.
class Textures {
  public:
    // What a material has for it.
    [[nodiscard]] Json use(const Image& image) {
        std::string uri;
        Poco::URI::encode(image.path, "?#[]@!$&'()*+,;=:%", uri);
        Json texture = {{"source", images_.size()}};
        images_.push_back({{"uri", uri}});
        if (image.clamped) {
            texture["sampler"] = 0;
            clamped_ = true;
        }
        Json used = {{"index", textures_.size()}};
        textures_.push_back(std::move(texture));
        if (image.offset != glm::vec2(0.0F) || image.scale != glm::vec2(1.0F)) {
            used["extensions"][kTransformExtension] = {{"offset", {image.offset.x, image.offset.y}},
                                                       {"scale", {image.scale.x, image.scale.y}}};
            moved_ = true;
        }
        return used;
    }

    void moveInto(Json& root) {
        if (!textures_.empty()) {
            root["images"] = std::move(images_);
            root["textures"] = std::move(textures_);
        }
        if (clamped_) {
            root["samplers"] = {{{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}}};
        }
        if (moved_) {
            root["extensionsUsed"] = {kTransformExtension};
        }
    }

  private:
    Json images_ = Json::array();
    Json textures_ = Json::array();
    bool clamped_ = false;
    bool moved_ = false;
};

Json materialJson(const Material& material, Textures& textures) {
    const glm::vec4& base = material.base_color;
    Json surface = {{"baseColorFactor", {base.x, base.y, base.z, base.w}},
                    {"metallicFactor", material.metallic},
                    {"roughnessFactor", material.roughness}};
    Json json = {{"doubleSided", true}};
    if (!material.name.empty()) {
        json["name"] = printable(material.name, 240);
    }
    if (material.emissive != glm::vec3(0.0F)) {
        json["emissiveFactor"] = {material.emissive.x, material.emissive.y, material.emissive.z};
    }
    const auto useIn = [&](Json& place, const char* key, const Image& image) {
        if (!image.path.empty()) {
            place[key] = textures.use(image);
        }
    };
    useIn(surface, "baseColorTexture", material.base_color_image);
    useIn(surface, "metallicRoughnessTexture", material.roughness_image);
    useIn(json, "emissiveTexture", material.emissive_image);
    useIn(json, "normalTexture", material.normal_image);
    json["pbrMetallicRoughness"] = std::move(surface);
    if (material.cut_out) {
        json["alphaMode"] = "MASK";
    } else if (base.w < 1) {
        json["alphaMode"] = "BLEND";
    }
    return json;
}

Json primitiveJson(const Part& part, BinaryBuffer& buffer) {
    Json attributes = {{"POSITION", buffer.addVectors(part.positions, true)}};
    if (!part.normals.empty()) {
        attributes["NORMAL"] = buffer.addVectors(part.normals);
    }
    if (!part.texcoords.empty()) {
        attributes["TEXCOORD_0"] = buffer.addVectors(part.texcoords);
    }
    if (!part.colors.empty()) {
        attributes["COLOR_0"] = buffer.addVectors(part.colors);
    }
    Json json = {{"attributes", std::move(attributes)}, {"material", part.material}};
    if (!part.indices.empty()) {
        json["indices"] = buffer.addIndices(part.indices, part.positions.size());
    }
    return json;
}

Json meshJson(const Mesh& mesh, BinaryBuffer& buffer) {
    Json json = {{"primitives", Json::array()}};
    if (!mesh.name.empty()) {
        json["name"] = printable(mesh.name, 240);
    }
    for (const Part& part : mesh.parts) {
        json["primitives"].push_back(primitiveJson(part, buffer));
    }
    return json;
}

// The file's axes and unit as glTF's.
Json rootNode(const Model& model) {
    Json node = {{"children", Json::array()}};
    if (model.unit_m != 1) {
        node["scale"] = {model.unit_m, model.unit_m, model.unit_m};
    }
    if (model.z_up) { // a quarter about x
        constexpr double kHalf = 0.70710678118654752440;
        node["rotation"] = {-kHalf, 0.0, 0.0, kHalf};
    }
    return node;
}

Json placedNode(const Placed& placed, const Mesh& mesh) {
    Json node = {{"mesh", placed.mesh}};
    if (!mesh.name.empty()) {
        node["name"] = printable(mesh.name, 240);
    }
    if (placed.transform != glm::mat4(1.0F)) {
        node["matrix"] = Json::array();
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                node["matrix"].push_back(placed.transform[column][row]);
            }
        }
    }
    return node;
}

} // namespace

std::vector<std::byte> glbOf(const Model& model) {
    BinaryBuffer buffer;
    Textures textures;
    Json root = {{"asset", {{"version", "2.0"}, {"generator", "froxel"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", Json::array({0})}}})},
                 {"nodes", Json::array({rootNode(model)})}};
    for (const Material& material : model.materials) {
        root["materials"].push_back(materialJson(material, textures));
    }
    for (const Mesh& mesh : model.meshes) {
        root["meshes"].push_back(meshJson(mesh, buffer));
    }
    for (const Placed& placed : model.placed) {
        root["nodes"][0]["children"].push_back(root["nodes"].size());
        root["nodes"].push_back(placedNode(placed, model.meshes[placed.mesh]));
    }
    textures.moveInto(root);
    root["accessors"] = buffer.accessors();
    root["bufferViews"] = buffer.views();
    root["buffers"] = Json::array({{{"byteLength", buffer.bytes().size()}}});
    const auto frame = gltf_writer::glbFrame(root.dump(), buffer.bytes().size());
    if (!frame) {
        gltf::fail("it " + frame.error().message);
    }
    std::vector<std::byte> glb;
    glb.reserve(frame->total_bytes);
    glb.insert(glb.end(), frame->before.begin(), frame->before.end());
    glb.insert(glb.end(), buffer.bytes().begin(), buffer.bytes().end());
    glb.resize(frame->total_bytes);
    return glb;
}

} // namespace froxel::formats
