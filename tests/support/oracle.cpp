#include "support/oracle.h"

#include "cluster/light_assigner.h"
#include "light/light_rig.h"
#include "reference/shade.h"
#include "render/lists/light_grid.h"
#include "render/view/visibility_readback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace froxel::test {

namespace {

// Where a pixel's surface lies, from the device's depth: view space, in double.
glm::dvec3
positionOf(const settings::ViewSettings& settings, uint32_t x, uint32_t y, double distance) {
    const auto& camera = settings.camera;
    const bool perspective = camera.projection == settings::Projection::kPerspective;
    const double half = perspective ? std::tan(camera.yfov_rad / 2) : camera.half_height_m;
    const double aspect = static_cast<double>(settings.size.width_px) / settings.size.height_px;
    const double scale = perspective ? half * distance : half;
    const double right = (x + 0.5) / settings.size.width_px * 2 - 1 + camera.lens_shift.x;
    const double up = 1 - (y + 0.5) / settings.size.height_px * 2 + camera.lens_shift.y;
    return {right * scale * aspect, up * scale, -distance};
}

// Whether a light adds anything at a point, as if it reached 1e-6 farther.
bool reaches(const light::FrameLights& lights, size_t index, const glm::dvec3& point) {
    const io::Light& light = lights.lights[index];
    const glm::dvec3 to_light = glm::dvec3(light.position_view) - point;
    const double distance = glm::length(to_light);
    if (!(distance < static_cast<double>(lights.radii_m[index]) * (1 + 1e-6))) {
        return false;
    }
    if (light.spot == io::kNoSpot) {
        return true;
    }
    const io::Spot& spot = lights.spots[light.spot];
    const double towards =
        -glm::dot(glm::dvec3(spot.direction_view), to_light) / std::max(distance, 0.01);
    return towards * static_cast<double>(spot.scale) + static_cast<double>(spot.offset) > 0;
}

double distanceOf(const settings::Camera& camera, float depth) {
    EXPECT_EQ(camera.projection, settings::Projection::kPerspective)
        << "no far plane is known here";
    return camera.near_m / static_cast<double>(depth);
}

} // namespace

Reference
refer(render::Renderer& renderer, const scene::Scene& scene, const render::FrameInputs& inputs) {
    Reference reference;
    auto visibility = render::readVisibility(renderer, scene, inputs);
    if (!visibility) {
        ADD_FAILURE() << visibility.error().message;
        return reference;
    }
    reference.visibility = std::move(*visibility);
    auto picture = reference::shade(scene, inputs.settings, inputs.time_s, reference.visibility);
    if (!picture) {
        ADD_FAILURE() << picture.error().message;
        return reference;
    }
    reference.picture = std::move(*picture);
    return reference;
}

PairCheck checkPairs(const scene::Scene& scene,
                     const render::FrameInputs& inputs,
                     const Visibility& visibility) {
    const auto& settings = inputs.settings;
    light::FrameLights lights;
    light::LightRig(scene).evaluate(settings.lights, settings.camera, inputs.time_s, lights);
    auto clustered = settings;
    clustered.renderer = settings::Renderer::kForwardPlus;
    clustered.light_loop = settings::LightLoop::kLists;
    render::LightGrid chosen;
    chosen.choose(clustered, lights, scene.bounds_world, cluster::Lit::kSurfaces,
                  cluster::kCpuCosts);
    const cluster::ClusterGrid& grid = chosen.grid();
    cluster::LightLists lists;
    cluster::LightAssigner(1).assign(grid, lights, lists);

    PairCheck check;
    std::vector<bool> listed;
    for (uint32_t y = 0; y < visibility.height_px; ++y) {
        for (uint32_t x = 0; x < visibility.width_px; ++x) {
            const float depth = visibility.depths[size_t{y} * visibility.width_px + x];
            if (!(depth > 0)) {
                continue;
            }
            const double distance = distanceOf(settings.camera, depth);
            const auto slice = grid.sliceAt(static_cast<float>(distance));
            listed.assign(lights.lights.size(), false);
            if (slice) {
                const auto& list = lists.clusters[grid.clusterIndex(
                    x / grid.tile_width_px, y / grid.tile_height_px, *slice)];
                for (uint32_t i = 0; i < list.count; ++i) {
                    listed[lists.indices[list.offset + i]] = true;
                }
            }
            const glm::dvec3 point = positionOf(settings, x, y, distance);
            for (size_t i = 0; i < lights.lights.size(); ++i) {
                const bool reached = reaches(lights, i, point);
                check.contributing += reached ? 1U : 0U;
                check.missing += reached && !listed[i] ? 1U : 0U;
            }
        }
    }
    return check;
}

Worst worstOf(const Picture& picture,
              const Reference& reference,
              const std::function<double(double)>& allowed) {
    Worst worst;
    const auto& expected = reference.picture.rgb;
    EXPECT_EQ(picture.radiance.size(), expected.size());
    for (size_t i = 0; i < std::min(picture.radiance.size(), expected.size()); ++i) {
        const VisibleTriangle& seen = reference.visibility.pixels[i / 3];
        if (seen.instance == VisibleTriangle::kNothing) {
            continue;
        }
        const auto device = static_cast<double>(picture.radiance[i]);
        const auto wanted = static_cast<double>(expected[i]);
        const double ratio = std::abs(device - wanted) / allowed(wanted);
        if (!(ratio <= worst.ratio)) { // also where it is no number
            const auto pixel = static_cast<uint32_t>(i / 3);
            worst = {ratio, device, wanted, pixel % picture.width_px, pixel / picture.width_px};
        }
    }
    return worst;
}

std::ostream& operator<<(std::ostream& out, const Worst& worst) {
    return out << "pixel " << worst.x << ", " << worst.y << " has " << worst.device
               << ", the reference " << worst.reference;
}

void expectNoneMissing(const scene::Scene& scene,
                       const render::FrameInputs& inputs,
                       const Visibility& visibility) {
    const PairCheck check = checkPairs(scene, inputs, visibility);
    EXPECT_GT(check.contributing, 0U);
    EXPECT_EQ(check.missing, 0U);
}

} // namespace froxel::test
