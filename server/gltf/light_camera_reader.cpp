#include "gltf/light_camera_reader.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "motion/affine.h"

#include <tiny_gltf.h>

namespace froxel::gltf {
namespace {

[[noreturn]] void
failValue(const std::string& user, const char* property, double value, const char* right) {
    fail(user + " has " + property + " " + numberText(value) + "; right is " + right);
}

glm::dmat3 rotationOf(const glm::dmat4& world_from_node, const std::string& user) {
    const auto axes = motion::axesOf(world_from_node);
    if (!axes) {
        fail(user + " is on a node whose scale is 0; right is a scale that leaves a direction");
    }
    return *axes;
}

void readPerspective(const tinygltf::PerspectiveCamera& source,
                     settings::Camera& camera,
                     const std::string& user) {
    if (!(source.yfov > 0 && source.yfov < glm::pi<double>())) {
        failValue(user, "yfov", source.yfov, "above 0 and below pi radians");
    }
    if (!(source.znear > 0)) {
        failValue(user, "znear", source.znear, "above 0");
    }
    camera.projection = settings::Projection::kPerspective;
    camera.yfov_rad = source.yfov;
    camera.near_m = source.znear;
}

void readOrthographic(const tinygltf::OrthographicCamera& source,
                      settings::Camera& camera,
                      const std::string& user) {
    if (!(source.ymag > 0)) {
        failValue(user, "ymag", source.ymag, "above 0");
    }
    if (!(source.znear >= 0)) {
        failValue(user, "znear", source.znear, "0 or more");
    }
    camera.projection = settings::Projection::kOrthographic;
    camera.half_height_m = source.ymag;
    camera.near_m = source.znear;
}

scene::LightType lightTypeFrom(const std::string& text, const std::string& user) {
    if (text == "point") {
        return scene::LightType::kPoint;
    }
    if (text == "spot") {
        return scene::LightType::kSpot;
    }
    if (text == "directional") {
        return scene::LightType::kDirectional;
    }
    fail(user + " has the type '" + printable(text) + "'; right is point, spot or directional");
}

} // namespace

scene::NamedCamera readCamera(const tinygltf::Camera& camera,
                              const glm::dmat4& world_from_node,
                              const std::string& user) {
    scene::NamedCamera result;
    result.name = camera.name;
    result.camera.eye_world = glm::dvec3(world_from_node[3]);
    result.camera.world_from_view = rotationOf(world_from_node, user);
    if (camera.type == "perspective") {
        readPerspective(camera.perspective, result.camera, user);
    } else {
        readOrthographic(camera.orthographic, result.camera, user);
    }
    return result;
}

scene::PunctualLight readLight(const tinygltf::Light& light,
                               const glm::dmat4& world_from_node,
                               const std::string& user) {
    scene::PunctualLight result;
    result.name = light.name;
    result.type = lightTypeFrom(light.type, user);
    result.position_world = glm::dvec3(world_from_node[3]);
    if (result.type != scene::LightType::kPoint) {
        const glm::dvec3 back(world_from_node[2]);
        const double length = glm::length(back);
        if (!(length > 0)) {
            fail(user + " is on a node whose scale is 0; right is a scale that leaves a direction");
        }
        result.direction_world = -back / length;
    }
    if (!light.color.empty() && light.color.size() != 3) {
        failValue(user, "a color of length", static_cast<double>(light.color.size()), "3");
    }
    for (size_t i = 0; i < light.color.size(); ++i) {
        if (!(light.color[i] >= 0 && light.color[i] <= 1)) {
            failValue(user, "the color component", light.color[i], "0 to 1");
        }
        result.color[static_cast<int>(i)] = static_cast<float>(light.color[i]);
    }
    if (!(light.intensity >= 0)) {
        failValue(user, "intensity", light.intensity, "0 or more");
    }
    if (!(light.range >= 0)) {
        failValue(user, "range", light.range, "above 0");
    }
    result.intensity = static_cast<float>(light.intensity);
    result.range_m = static_cast<float>(light.range);
    if (result.type == scene::LightType::kSpot) {
        const double inner = light.spot.innerConeAngle;
        const double outer = light.spot.outerConeAngle;
        // tinygltf's default is pi/4 to ten digits, above which an exact pi/4 would be refused.
        if (!(outer > 0 && outer <= glm::half_pi<double>() + 1e-6)) {
            failValue(user, "outerConeAngle", outer, "above 0 and at most pi/2 radians");
        }
        if (!(inner >= 0 && inner < outer)) {
            failValue(user, "innerConeAngle", inner, "0 or more and below outerConeAngle");
        }
        result.inner_cone_rad = inner;
        result.outer_cone_rad = glm::min(outer, glm::half_pi<double>());
    }
    return result;
}

} // namespace froxel::gltf
