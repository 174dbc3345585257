#include "gltf_writer/node_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace froxel::gltf_writer {
namespace {

Json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json matrixJson(const glm::dmat4& matrix) {
    Json json = Json::array();
    for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 4; ++row) {
            json.push_back(matrix[column][row]);
        }
    }
    return json;
}

Json named(const std::string& name) {
    Json json = Json::object();
    if (!name.empty()) {
        json["name"] = name;
    }
    return json;
}

// A node's matrix must decompose to translation, rotation and scale.
const char* whyNotAMatrix(const glm::dmat4& m) {
    for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 4; ++row) {
            if (!std::isfinite(m[column][row])) {
                return "is not finite";
            }
        }
    }
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
        return "is not affine";
    }
    constexpr double kRightAngle = 1e-5; // cosine
    const glm::dmat3 linear(m);
    for (const glm::ivec2 pair : {glm::ivec2(0, 1), glm::ivec2(0, 2), glm::ivec2(1, 2)}) {
        const glm::dvec3& a = linear[pair.x];
        const glm::dvec3& b = linear[pair.y];
        if (std::abs(glm::dot(a, b)) > kRightAngle * glm::length(a) * glm::length(b)) {
            return "is sheared, which a glTF node cannot be";
        }
    }
    return nullptr;
}

} // namespace

Result<void> addInstanceNode(const scene::Instance& instance, Json& nodes) {
    const glm::dmat4& m = instance.world_from_object;
    if (const char* reason = whyNotAMatrix(m)) {
        return Error{ErrorCode::kScene,
                     "instance '" + instance.name + "': its transform " + reason};
    }
    Json node = named(instance.name);
    node["mesh"] = instance.mesh;
    const glm::dvec3 position(m[3]);
    if (glm::dmat3(m) != glm::dmat3(1.0)) {
        node["matrix"] = matrixJson(m);
    } else if (position != glm::dvec3(0)) {
        node["translation"] = vectorJson(position);
    }
    nodes.push_back(std::move(node));
    return {};
}

Json cameraNode(const scene::NamedCamera& camera, uint32_t index) {
    glm::dmat4 world_from_view(camera.camera.world_from_view);
    world_from_view[3] = glm::dvec4(camera.camera.eye_world, 1.0);
    Json node = named(camera.name);
    node["camera"] = index;
    node["matrix"] = matrixJson(world_from_view);
    return node;
}

Json cameraJson(const scene::NamedCamera& named_camera, const BoundsD3& scene_bounds) {
    const settings::Camera& camera = named_camera.camera;
    Json json = named(named_camera.name);
    if (camera.projection == settings::Projection::kPerspective) {
        json["type"] = "perspective";
        json["perspective"] = {{"yfov", camera.yfov_rad}, {"znear", camera.near_m}};
        return json;
    }
    double reach = 1.0;
    if (!scene_bounds.empty()) {
        reach += glm::length(scene_bounds.size()) +
                 glm::length(scene_bounds.center() - camera.eye_world);
    }
    json["type"] = "orthographic";
    json["orthographic"] = {{"xmag", camera.half_height_m},
                            {"ymag", camera.half_height_m},
                            {"znear", camera.near_m},
                            {"zfar", camera.near_m + reach}};
    return json;
}

Json lightNode(const scene::PunctualLight& light, uint32_t index) {
    Json node = named(light.name);
    // A glTF light shines along its node's -Z.
    const settings::Camera aim = settings::lookAt(
        light.position_world, light.position_world + light.direction_world, {0, 1, 0});
    if (light.type == scene::LightType::kPoint) {
        node["translation"] = vectorJson(light.position_world);
    } else {
        glm::dmat4 world_from_light(aim.world_from_view);
        world_from_light[3] = glm::dvec4(light.position_world, 1.0);
        node["matrix"] = matrixJson(world_from_light);
    }
    node["extensions"][kLightsExtension] = {{"light", index}};
    return node;
}

Json lightJson(const scene::PunctualLight& light) {
    Json json = named(light.name);
    json["color"] = {light.color.x, light.color.y, light.color.z};
    json["intensity"] = light.intensity;
    switch (light.type) {
    case scene::LightType::kPoint:
        json["type"] = "point";
        break;
    case scene::LightType::kDirectional:
        json["type"] = "directional";
        break;
    case scene::LightType::kSpot:
        json["type"] = "spot";
        json["spot"] = {{"innerConeAngle", light.inner_cone_rad},
                        {"outerConeAngle", light.outer_cone_rad}};
        break;
    }
    if (light.range_m > 0 && light.type != scene::LightType::kDirectional) {
        json["range"] = light.range_m;
    }
    return json;
}

} // namespace froxel::gltf_writer
