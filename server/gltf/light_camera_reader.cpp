#include "gltf/light_camera_reader.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/word_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace froxel::gltf {
namespace {

// Of a perspective camera that tells none: a hand before the eye is still seen.
constexpr double kNear_m = 0.01;

// A camera or a light of the file, and what is said of its values.
class Subject {
  public:
    Subject(std::string pointer, std::string name, const WarningKind& kind, Warnings& warnings)
        : pointer_(std::move(pointer)), name_(std::move(name)), kind_(kind), warnings_(warnings) {}

    void tell(const std::string& what) const { warnings_.add(kind_, pointer_, name_ + " " + what); }
    void tell(const WarningKind& kind, const std::string& what) const {
        warnings_.add(kind, pointer_, name_ + " " + what);
    }
    // `value`, or `instead` where it is not `right`.
    [[nodiscard]] double number(const char* property,
                                double value,
                                bool is_right,
                                const char* right,
                                double instead) const {
        if (is_right) {
            return value;
        }
        tell(std::string("has ") + property + " " + numberText(value) + "; " + numberText(instead) +
             " is used; expected " + right);
        return instead;
    }

  private:
    std::string pointer_;
    std::string name_;
    const WarningKind& kind_;
    Warnings& warnings_;
};

bool readLens(const CameraSource& source, settings::Camera& camera, const Subject& subject) {
    if (source.type == "perspective") {
        if (!(source.size > 0 && source.size < glm::pi<double>())) {
            subject.tell("has yfov " + numberText(source.size) +
                         " and is left out; expected above 0 and below pi radians");
            return false;
        }
        camera.projection = settings::Projection::kPerspective;
        camera.yfov_rad = source.size;
        camera.near_m =
            subject.number("znear", source.near_m, source.near_m > 0, "above 0", kNear_m);
        return true;
    }
    if (source.type == "orthographic") {
        if (source.size == 0) {
            subject.tell("has ymag 0 and is left out; expected above 0");
            return false;
        }
        camera.projection = settings::Projection::kOrthographic;
        camera.half_height_m =
            subject.number("ymag", source.size, source.size > 0, "above 0", std::abs(source.size));
        camera.near_m = subject.number("znear", source.near_m, source.near_m >= 0, "0 or more", 0);
        return true;
    }
    subject.tell("has the type '" + printable(source.type, 40) +
                 "' and is left out; expected perspective or orthographic");
    return false;
}

std::optional<scene::LightType> lightTypeFrom(const std::string& text, const Subject& subject) {
    constexpr std::pair<const char*, scene::LightType> kTypes[] = {
        {"point", scene::LightType::kPoint},
        {"spot", scene::LightType::kSpot},
        {"directional", scene::LightType::kDirectional}};
    const auto type = named(kTypes, text);
    if (!type) {
        subject.tell("has the type '" + printable(text, 40) +
                     "' and is left out; expected point, spot or directional");
    }
    return type;
}

void readCones(const LightSource& source, scene::PunctualLight& light, const Subject& subject) {
    const auto tell = [&](const char* which, double value, double used, const char* right) {
        subject.tell(warning::kConeAngles, std::string("has ") + which + " " + numberText(value) +
                                               "; " + numberText(used) + " is used; expected " +
                                               right);
    };
    constexpr double kWidest = glm::half_pi<double>();
    light.outer_cone_rad = std::clamp(source.outer_cone_rad, 0.0, kWidest);
    // Of pi/2 exporters write more digits or fewer.
    if (!(source.outer_cone_rad > 0 && source.outer_cone_rad <= kWidest + 1e-6)) {
        tell("outerConeAngle", source.outer_cone_rad, light.outer_cone_rad,
             "above 0 and at most pi/2 radians");
    }
    light.inner_cone_rad = std::clamp(source.inner_cone_rad, 0.0, light.outer_cone_rad);
    if (!(source.inner_cone_rad >= 0 && source.inner_cone_rad < source.outer_cone_rad)) {
        tell("innerConeAngle", source.inner_cone_rad, light.inner_cone_rad,
             "0 or more and below outerConeAngle");
    }
}

// Beyond 1 is brighter than the intensity says, and kept.
glm::vec3 colorFrom(const LightSource& source, const Subject& subject) {
    glm::vec3 color(1);
    for (size_t i = 0; i < source.color.size(); ++i) {
        const double value = source.color[i];
        color[static_cast<int>(i)] = static_cast<float>(
            subject.number("the color component", value, value >= 0, "0 to 1", 0));
        if (value > 1) {
            subject.tell("has the colour component " + numberText(value) +
                         ", which is kept; expected 0 to 1");
        }
    }
    return color;
}

void tellNoDirection(const Subject& subject) {
    subject.tell(warning::kNoDirection,
                 "is on a node of scale 0, which has no direction; it is left out");
}

} // namespace

std::optional<scene::NamedCamera> readCamera(const CameraSource& source,
                                             size_t index,
                                             const glm::dvec3& eye_world,
                                             const NodeAxes& world_from_view,
                                             Warnings& warnings) {
    const Subject subject(pointerTo("cameras", index), thing("camera", index),
                          warning::kCameraValue, warnings);
    if (!world_from_view) {
        tellNoDirection(subject);
        return std::nullopt;
    }
    scene::NamedCamera result;
    result.name = source.name;
    result.camera.eye_world = eye_world;
    result.camera.world_from_view = *world_from_view;
    return readLens(source, result.camera, subject) ? std::optional(result) : std::nullopt;
}

std::optional<scene::PunctualLight> readLight(const LightSource& source,
                                              size_t index,
                                              const glm::dvec3& position_world,
                                              const NodeAxes& axes_world,
                                              Warnings& warnings) {
    const Subject subject("/extensions/KHR_lights_punctual" + pointerTo("lights", index),
                          thing("light", index), warning::kLightValue, warnings);
    const auto type = lightTypeFrom(source.type, subject);
    if (!type) {
        return std::nullopt;
    }
    scene::PunctualLight result;
    result.name = source.name;
    result.type = *type;
    result.position_world = position_world;
    if (result.type != scene::LightType::kPoint) {
        if (!axes_world) {
            tellNoDirection(subject);
            return std::nullopt;
        }
        result.direction_world = -(*axes_world)[2];
    }
    result.color = colorFrom(source, subject);
    result.intensity = static_cast<float>(
        subject.number("intensity", source.intensity, source.intensity >= 0, "0 or more", 0));
    if (source.range_m < 0) {
        subject.tell("has range " + numberText(source.range_m) +
                     "; its range is unlimited; expected above 0");
    }
    result.range_m = static_cast<float>(std::max(source.range_m, 0.0));
    if (result.type == scene::LightType::kSpot) {
        readCones(source, result, subject);
    }
    return result;
}

} // namespace froxel::gltf
