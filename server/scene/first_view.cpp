#include "scene/first_view.h"

#include "core/text.h"
#include "scene/enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace froxel::scene {

namespace {

constexpr double kEyeHeight_m = 1.6;
// Of a room's height, the eye at most.
constexpr double kEyeOfHeight = 0.6;
constexpr double kLowestRoom_m = 2.2;
constexpr double kUsualRoom_m = 2.7;
constexpr double kHighestRoom_m = 25;
// glTF's is the metre. Exporters of SketchUp and CAD keep what the drawing has.
constexpr std::array kUnits_m = {1.0, 0.01, 0.0254, 0.001};
// Of the way behind the eye, which keeps off the wall.
constexpr double kStepBack = 0.8;
// Of the surfaces that the best corner shows; where the usual one shows less, it is not taken.
constexpr double kEnough = 0.1;

// Of a scene with more triangles every so-manieth is looked at.
constexpr uint64_t kMostLookedAt = uint64_t{1} << 24U;
// Cameras that are tried: each looks at them anew.
constexpr size_t kMostTried = 32;

size_t strideOf(const Scene& scene) {
    uint64_t triangles = 0;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            triangles += primitive.indices.size() / 3;
        }
    }
    return triangles / kMostLookedAt + 1;
}

// Calls visit(corners in the world, whether both sides are drawn) for each triangle until it
// returns true; whether it did.
template <class Visit>
bool anyTriangle(const Scene& scene, const Visit& visit) {
    const size_t step = 3 * strideOf(scene);
    for (const Instance& instance : scene.instances) {
        const bool mirrors = glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const bool both = scene.materials[primitive.material].double_sided;
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += step) {
                std::array<glm::dvec3, 3> corners;
                for (size_t k = 0; k < 3; ++k) {
                    corners[k] =
                        glm::dvec3(instance.world_from_object *
                                   glm::dvec4(primitive.positions[primitive.indices[i + k]], 1));
                }
                if (mirrors) {
                    std::swap(corners[1], corners[2]);
                }
                if (visit(corners, both)) {
                    return true;
                }
            }
        }
    }
    return false;
}

glm::dvec3 doubleArea(const std::array<glm::dvec3, 3>& corners) {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

// The corner that most surfaces face, where hardly any faces the usual one; else none.
std::optional<glm::dvec3> betterSide(const Scene& scene) {
    constexpr size_t kSides = 8;
    std::array<glm::dvec3, kSides> sides;
    for (unsigned i = 0; i < kSides; ++i) { // 0 is the usual one
        sides[i] =
            glm::normalize(settings::kUsualTowardEye) *
            glm::dvec3((i & 1U) != 0 ? -1 : 1, (i & 4U) != 0 ? -1 : 1, (i & 2U) != 0 ? -1 : 1);
    }
    std::array<double, kSides> shown{};
    anyTriangle(scene, [&](const auto& corners, bool both) {
        const glm::dvec3 area = doubleArea(corners);
        for (size_t i = 0; i < kSides; ++i) {
            const double faced = glm::dot(area, sides[i]);
            shown[i] += both ? std::abs(faced) : std::max(faced, 0.0);
        }
        return false;
    });
    const auto best =
        static_cast<size_t>(std::max_element(shown.begin(), shown.end()) - shown.begin());
    return shown[0] < kEnough * shown[best] ? std::optional(sides[best]) : std::nullopt;
}

double freeWay(const std::optional<RayHit>& hit, double otherwise) {
    return hit ? hit->distance_m : otherwise;
}

// In the scene's units. A room of another height than rooms have in any unit is a model of one.
double eyeHeight(double height) {
    double eye = kEyeOfHeight * height;
    double best = std::numeric_limits<double>::infinity();
    for (const double unit_m : kUnits_m) {
        const double height_m = height * unit_m;
        const double unlikely = std::abs(std::log(height_m / kUsualRoom_m));
        if (height_m >= kLowestRoom_m && height_m <= kHighestRoom_m && unlikely < best) {
            best = unit_m == 1 ? 0 : unlikely; // as the format has it
            eye = std::min(kEyeOfHeight * height, kEyeHeight_m / unit_m);
        }
    }
    return eye;
}

// The one that most of the others are near to, the first of those that are as many.
double commonest(const std::vector<double>& values, double near) {
    double common = 0;
    ptrdiff_t most = 0;
    for (const double value : values) {
        const auto count = std::ranges::count_if(
            values, [&](double other) { return std::abs(other - value) <= near; });
        if (count > most) {
            most = count;
            common = value;
        }
    }
    return common;
}

struct Storey {
    double floor = 0;
    double ceiling = 0;
};

// The widest around the middle: straight below it a table may stand.
Storey storeyAround(const Scene& scene, const glm::dvec3& middle) {
    const BoundsD3& bounds = scene.bounds_world;
    std::vector<double> floors;
    std::vector<double> ceilings;
    constexpr double kAside = 0.25; // of the scene's sides
    for (const double x : {-kAside, 0.0, kAside}) {
        for (const double z : {-kAside, 0.0, kAside}) {
            const glm::dvec3 from = middle + bounds.size() * glm::dvec3(x, 0, z);
            const auto hits = castRays(scene, from, {{0, -1, 0}, {0, 1, 0}});
            floors.push_back(from.y - freeWay(hits[0], from.y - bounds.min.y));
            ceilings.push_back(from.y + freeWay(hits[1], bounds.max.y - from.y));
        }
    }
    std::ranges::sort(floors);
    std::ranges::sort(ceilings, std::greater());
    const double near = 0.02 * bounds.size().y;
    return {commonest(floors, near), commonest(ceilings, near)};
}

settings::Camera viewFromWithin(const Scene& scene) {
    const BoundsD3& bounds = scene.bounds_world;
    glm::dvec3 at = bounds.center();
    const Storey storey = storeyAround(scene, at);
    at.y = storey.floor + eyeHeight(storey.ceiling - storey.floor);

    constexpr size_t kWays = 16; // and as many back
    std::vector<glm::dvec3> ways;
    for (size_t i = 0; i < 2 * kWays; ++i) {
        const double angle_rad = glm::pi<double>() * static_cast<double>(i) / kWays;
        ways.emplace_back(std::sin(angle_rad), 0, -std::cos(angle_rad));
    }
    const auto hits = castRays(scene, at, ways);
    const double out_m = 0.5 * glm::length(glm::dvec2(bounds.size().x, bounds.size().z));
    const auto length = [&](size_t i) { return freeWay(hits[i], out_m); };
    size_t best = 0;
    for (size_t i = 1; i < kWays; ++i) {
        if (length(i) + length(i + kWays) > length(best) + length(best + kWays)) {
            best = i;
        }
    }
    const glm::dvec3 eye = at + ways[best + kWays] * (kStepBack * length(best + kWays));
    settings::Camera camera = settings::lookAt(eye, at + ways[best] * length(best), {0, 1, 0});
    camera.yfov_rad = glm::radians(60.0); // a room wants more of it
    camera.near_m = std::min(camera.near_m, 1e-3 * camera.focus_m);
    return camera;
}

Warning remarkOf(const char* code, std::string message) {
    return {code, Severity::kInformation, "", std::move(message)};
}

} // namespace

bool seesAnything(const Scene& scene, const settings::Camera& camera) {
    const glm::dmat3 view_from_world = glm::transpose(camera.world_from_view);
    const bool flat = camera.projection == settings::Projection::kOrthographic;
    const double slope = std::tan(0.5 * camera.yfov_rad);
    return anyTriangle(scene, [&](const auto& corners, bool both) {
        bool behind = true;
        bool above = true;
        bool below = true;
        for (const glm::dvec3& corner : corners) {
            const glm::dvec3 view = view_from_world * (corner - camera.eye_world);
            const double half = flat ? camera.half_height_m : -view.z * slope;
            const double y = view.y - half * camera.lens_shift.y;
            behind = behind && -view.z < camera.near_m;
            above = above && y > half;
            below = below && y < -half;
        }
        const glm::dvec3 toward_eye =
            flat ? camera.world_from_view[2] : camera.eye_world - corners[0];
        return !behind && !above && !below &&
               (both || glm::dot(doubleArea(corners), toward_eye) > 0);
    });
}

settings::Camera FirstView::cameraFor(const settings::Size& size) const {
    return camera ? *camera
                  : settings::overview(sphere_world, settings::aspectOf(size), toward_eye);
}

FirstView firstViewOf(const Scene& scene, const settings::Sphere& sphere_world) {
    FirstView view;
    view.sphere_world = sphere_world;
    const auto sees = [&](const NamedCamera& camera) { return seesAnything(scene, camera.camera); };
    const auto end = scene.cameras.begin() +
                     static_cast<std::ptrdiff_t>(std::min(scene.cameras.size(), kMostTried));
    const auto found = std::find_if(scene.cameras.begin(), end, sees);
    if (found != end) {
        view.scene_camera = static_cast<size_t>(found - scene.cameras.begin());
        view.camera = found->camera;
    }
    if (found != scene.cameras.begin()) {
        view.remark = remarkOf("CAMERA_SEES_NOTHING",
                               "camera '" + printable(scene.cameras[0].name, 80) +
                                   "' sees nothing of the scene; another view is shown first");
    }
    if (view.camera || scene.instances.empty()) {
        return view;
    }
    if (isRoom(scene)) {
        view.camera = viewFromWithin(scene);
        return view;
    }
    if (const auto side = betterSide(scene)) {
        view.toward_eye = *side;
        view.remark = remarkOf("FACES_LOOK_AWAY",
                               "hardly any surface faces the usual view from above, front and "
                               "right; the first view is from the corner that most surfaces face");
    }
    return view;
}

} // namespace froxel::scene
