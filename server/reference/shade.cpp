#include "reference/shade.h"

#include "reference/around.h"
#include "reference/blended.h"
#include "reference/brdf.h"
#include "reference/fog.h"
#include "reference/geometry.h"
#include "reference/lights.h"
#include "reference/material.h"
#include "reference/occluders.h"
#include "reference/tone_map.h"
#include "reference/toon.h"
#include "reference/transmission.h"
#include "reference/tree.h"
#include "settings/environment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>

namespace froxel::reference {
namespace {

std::vector<Placement> placementsOf(const scene::Scene& scene, const glm::dvec3& eye_world) {
    std::vector<Placement> placements;
    for (const auto& instance : scene.instances) {
        placements.emplace_back(instance, eye_world);
    }
    return placements;
}

const scene::Primitive&
primitiveOf(const scene::Scene& scene, uint32_t instance, uint32_t primitive) {
    return scene.meshes[scene.instances[instance].mesh].primitives[primitive];
}

// Those of pixels, of what is blended and, where there are shadows, of what is cut out; where rays
// are traced, all.
std::vector<uint32_t> visibleMaterials(const scene::Scene& scene,
                                       const Visibility& visibility,
                                       bool shadows,
                                       bool traced) {
    std::set<uint32_t> materials;
    std::pair last(VisibleTriangle::kNothing, 0U);
    for (const auto& pixel : visibility.pixels) {
        const std::pair now(pixel.instance, pixel.primitive);
        if (pixel.instance != VisibleTriangle::kNothing && now != last) {
            materials.insert(primitiveOf(scene, now.first, now.second).material);
            last = now;
        }
    }
    for (uint32_t i = 0; i < scene.materials.size(); ++i) {
        const auto mode = scene.materials[i].alpha_mode;
        if (mode == scene::AlphaMode::kBlend || (shadows && mode == scene::AlphaMode::kMask) ||
            traced) {
            materials.insert(i);
        }
    }
    return {materials.begin(), materials.end()};
}

Model modelOf(const settings::ViewSettings& settings) {
    Model model{.shading = settings.shading};
    const bool each = settings.renderer == settings::Renderer::kToonFragment;
    if (each) {
        model.ramp = &settings.toon_fragment;
        model.bands = settings.toon.bands;
    }
    if (each || settings.renderer == settings::Renderer::kToonCompute) {
        model.rim = static_cast<double>(settings.toon.rim);
        model.rim_width = static_cast<double>(settings.toon.rim_width);
    }
    return model;
}

class Shader {
  public:
    Shader(const scene::Scene& scene,
           const settings::ViewSettings& settings,
           double time_s,
           const Visibility& visibility,
           LightWay way)
        : scene_(scene), way_(way), settings_(settings), visibility_(visibility),
          rays_(settings.camera, settings.size), model_(modelOf(settings)),
          lights_(lightsAt(scene, settings, time_s)),
          medium_(settings.fog, settings.camera, lights_, open_),
          placements_(placementsOf(scene, settings.camera.eye_world)),
          materials_(scene,
                     visibleMaterials(scene,
                                      visibility,
                                      settings.shadows.light_count > 0,
                                      std::ranges::any_of(scene.materials, transmits)),
                     visibility.filter),
          layered_(scene, placements_, settings.camera, settings.size) {
        if (std::ranges::any_of(scene.materials, transmits)) {
            traced_.emplace(trianglesOf(scene, placements_, [](const auto&) { return true; }));
        }
        if (settings.shadows.light_count > 0) {
            occluders_.emplace(scene, placements_, materials_);
            open_ = [this](const glm::dvec3& from, const glm::dvec3& to) {
                return occluders_->passes(from, to);
            };
        }
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    [[nodiscard]] glm::dvec3 pixel(uint32_t x, uint32_t y) const {
        const auto& visible = visibility_.pixels[size_t{y} * visibility_.width_px + x];
        const Ray ray = rays_.through(x, y);
        Behind behind = nothing(ray);
        if (visible.instance != VisibleTriangle::kNothing) {
            const PixelHit hit{x, y, meet(visible, x, y)};
            behind = {shadeHit(hit, visible), hit.point.distance, isUnlit(visible)};
            if (settings_.renderer == settings::Renderer::kToonCompute) {
                const double norm = glm::length(behind.color);
                const double shade =
                    toonBand(settings_.toon.bands, toonRamp(settings_.toon_compute, norm), 0);
                behind.color *= norm > 0 ? shade / norm : 0.0;
            }
        }
        behind.color = medium_.seenThrough(behind.color, ray, behind.distance);
        return withLayers(behind, ray, {x, y}, layered_.at(x, y), 0);
    }

  private:
    [[nodiscard]] bool isUnlit(const VisibleTriangle& visible) const {
        return visible.instance != VisibleTriangle::kNothing &&
               scene_.materials[primitiveOf(scene_, visible.instance, visible.primitive).material]
                   .unlit;
    }
    // What a ray meets first that is solid.
    struct Behind {
        glm::dvec3 color;
        double distance;
        bool unlit;         // a colour of the display; so is then what is blended over it
        bool empty = false; // of the background alone
    };
    static constexpr uint32_t kMostLayers = 8;       // that a ray goes through, one behind another
    static constexpr uint32_t kLobeSamples = 128;    // of what a rough surface shows
    static constexpr uint32_t kMostReflections = 16; // inside of a mesh

    // As far as they are before it; `at`: the pixel whose ray it is.
    [[nodiscard]] glm::dvec3 withLayers(const Behind& behind,
                                        const Ray& ray,
                                        const glm::uvec2& at,
                                        std::span<const BlendedHit> layers,
                                        uint32_t depth) const {
        glm::dvec3 sum(0);
        double left = 1;
        for (const auto& layer : layers) {
            if (layer.point.distance > behind.distance) {
                continue;
            }
            const Surface s = depth == 0 ? surfaceAtPixel(layer, at) : surfaceAlongRay(layer, ray);
            const glm::dvec3 over =
                s.transmission.strength > 0
                    ? through(s, layer, ray, at, sum + left * asRadiance(behind, at), depth)
                    : radiance(s, model_, lights_, open_);
            sum = glm::mix(sum, medium_.seenThrough(over, ray, layer.point.distance), s.alpha);
            left *= 1 - s.alpha;
        }
        if (!behind.unlit || left == 1 || left == 0) {
            return sum + left * behind.color;
        }
        const glm::dvec3 shown = toneMapped(
            sum / (1 - left), static_cast<double>(settings_.exposure), settings_.tone_map);
        return glm::mix(glm::min(shown, glm::dvec3(1)), behind.color, left);
    }
    // What is seen through a surface is all radiance, also colours of the display.
    [[nodiscard]] glm::dvec3 asRadiance(const Behind& behind, const glm::uvec2& at) const {
        const auto shown = [&](const glm::dvec3& color) {
            return shownAs(color, static_cast<double>(settings_.exposure), settings_.tone_map);
        };
        if (behind.unlit) {
            return shown(behind.color);
        }
        if (!behind.empty) {
            return behind.color;
        }
        const double up = 1 - 2 * (at.y + 0.5) / settings_.size.height_px;
        return behind.color + shown(glm::dvec3(settings_.background.color) *
                                    (1 + static_cast<double>(settings_.background.gradient) * up));
    }
    // Radiance of a surface that transmits light, before the medium; straight: what is behind it as
    // seen through the medium.
    [[nodiscard]] glm::dvec3 through(Surface s,
                                     const BlendedHit& hit,
                                     const Ray& ray,
                                     const glm::uvec2& at,
                                     const glm::dvec3& straight,
                                     uint32_t depth) const {
        const Transmission& t = s.transmission;
        const Placement& placement = placements_[hit.instance];
        const auto withoutMedium = [&](const glm::dvec3& seen) {
            const glm::dvec3 before = medium_.seenThrough(glm::dvec3(0), ray, hit.point.distance);
            const glm::dvec3 passes =
                medium_.seenThrough(glm::dvec3(1), ray, hit.point.distance) - before;
            return glm::max(seen - before, glm::dvec3(0)) / passes;
        };
        if (t.thickness > 0) {
            s.transmission.left =
                glm::pow(t.attenuation, glm::dvec3(glm::length(wayThrough(s, placement, t.ior))));
        }
        glm::dvec3 seen(0);
        if (depth >= kMostLayers) {
            seen = glm::dvec3(0);
        } else if (way_ == LightWay::kThroughMesh && t.thickness > 0) {
            seen = throughMesh(s, hit, at, depth);
        } else if (t.roughness > 0) {
            for (const LobeSample& sample : throughLobe(s, kLobeSamples)) {
                const glm::dvec3 way =
                    t.thickness > 0 ? wayThrough(s, placement, t.ior) : glm::dvec3(0);
                seen +=
                    sample.share * along({s.position + way, sample.direction}, 0, at, depth + 1);
            }
        } else if (t.thickness == 0) {
            seen = withoutMedium(straight);
        } else {
            const auto bent = [&](double index) {
                double distance = 0;
                const glm::dvec2 exit =
                    rays_.project(s.position + wayThrough(s, placement, index), distance);
                return withoutMedium(along(rays_.through(exit), hit.point.distance, at, depth + 1));
            };
            seen = bent(t.ior);
            if (t.dispersion > 0) {
                const glm::dvec3 indices = indicesOf(t);
                seen.x = bent(indices.x).x;
                seen.z = bent(indices.z).z;
            }
        }
        return radiance(s, model_, lights_, open_, seen * s.transmission.left);
    }
    // From where a ray enters a mesh that is closed to where it leaves it, and on from there.
    [[nodiscard]] glm::dvec3
    throughMesh(Surface& s, const BlendedHit& hit, const glm::uvec2& at, uint32_t depth) const {
        const double ior = s.transmission.ior;
        const glm::dvec3 facing = glm::dot(s.normal, s.to_eye) < 0 ? -s.normal : s.normal;
        Ray inside{s.position, refracted(-s.to_eye, facing, 1 / ior).value()};
        double way = 0;
        for (uint32_t i = 0; i < kMostReflections; ++i) {
            const auto next = nearest(inside, 1e-6, [&](const TreeTriangle& triangle) {
                return triangle.instance == hit.instance && triangle.primitive == hit.primitive;
            });
            if (!next) {
                break; // not closed
            }
            way += next->point.distance;
            const SurfacePoint point =
                surfaceAlong(inside, next->point.weights, placements_[hit.instance],
                             primitiveOf(scene_, hit.instance, hit.primitive), next->triangle);
            const glm::dvec3 inwards =
                glm::dot(point.normal, inside.direction) > 0 ? -point.normal : point.normal;
            const auto out = refracted(inside.direction, inwards, ior);
            inside.origin = point.position;
            inside.direction = out ? *out : glm::reflect(inside.direction, inwards);
            if (out) {
                break;
            }
        }
        s.transmission.left = glm::pow(s.transmission.attenuation, glm::dvec3(way));
        return along(inside, 1e-6, at, depth + 1);
    }
    // The nearest triangle that a ray meets beyond a distance, of those that count.
    template <class Counts>
    [[nodiscard]] std::optional<BlendedHit>
    nearest(const Ray& ray, double from, Counts counts) const {
        std::optional<BlendedHit> found;
        (void)traced_->any(
            ray, std::numeric_limits<double>::max(), [&](const TreeTriangle& triangle) {
                const PlanePoint point = meetPlane(ray, triangle.placed);
                if (point.inside() && point.distance > from &&
                    (!found || point.distance < found->point.distance) && counts(triangle)) {
                    found = {triangle.instance, triangle.primitive, triangle.triangle, point};
                }
                return false;
            });
        return found;
    }
    // Whether the eye sees this side of a triangle.
    [[nodiscard]] bool showsSide(const TreeTriangle& triangle, const Ray& ray) const {
        const auto& m =
            scene_.materials[primitiveOf(scene_, triangle.instance, triangle.primitive).material];
        const glm::dvec3 front = glm::cross(triangle.placed.edge1, triangle.placed.edge2) *
                                 placements_[triangle.instance].side;
        return m.double_sided || glm::dot(front, ray.direction) < 0;
    }
    [[nodiscard]] bool isLayer(const TreeTriangle& triangle) const {
        return isLayered(
            scene_.materials[primitiveOf(scene_, triangle.instance, triangle.primitive).material]);
    }
    // All that a ray sees beyond a distance along it, through the medium; at: a pixel near it.
    [[nodiscard]] glm::dvec3
    along(const Ray& ray, double from, const glm::uvec2& at, uint32_t depth) const {
        const double after = from * (1 + 1e-9) + 1e-9;
        const auto solid = nearest(ray, after, [&](const TreeTriangle& triangle) {
            return !isLayer(triangle) && showsSide(triangle, ray);
        });
        Behind behind = nothing(ray);
        if (solid) {
            const Surface s = surfaceAlongRay(*solid, ray);
            behind = {radiance(s, model_, lights_, open_), solid->point.distance, s.unlit};
        }
        behind.color = asRadiance({medium_.seenThrough(behind.color, ray, behind.distance),
                                   behind.distance, behind.unlit, behind.empty},
                                  at);
        behind.unlit = behind.empty = false;
        std::vector<BlendedHit> layers;
        (void)traced_->any(ray, std::min(behind.distance, 1e30), [&](const TreeTriangle& triangle) {
            const PlanePoint point = meetPlane(ray, triangle.placed);
            if (point.inside() && point.distance > after && isLayer(triangle) &&
                showsSide(triangle, ray)) {
                layers.push_back({triangle.instance, triangle.primitive, triangle.triangle, point});
            }
            return false;
        });
        std::ranges::stable_sort(layers, std::greater(),
                                 [](const BlendedHit& hit) { return hit.point.distance; });
        return withLayers(behind, ray, at, layers, depth);
    }
    [[nodiscard]] Surface surfaceAlongRay(const BlendedHit& hit, const Ray& ray) const {
        const auto& primitive = primitiveOf(scene_, hit.instance, hit.primitive);
        return materials_.at(primitive.material,
                             surfaceAlong(ray, hit.point.weights, placements_[hit.instance],
                                          primitive, hit.triangle));
    }
    [[nodiscard]] Surface surfaceAtPixel(const BlendedHit& hit, const glm::uvec2& at) const {
        const auto& primitive = primitiveOf(scene_, hit.instance, hit.primitive);
        return materials_.at(primitive.material,
                             surfaceAt(rays_, {at.x, at.y, hit.point}, placements_[hit.instance],
                                       primitive, hit.triangle));
    }
    [[nodiscard]] Behind nothing(const Ray& ray) const {
        return {behind(ray), std::numeric_limits<double>::infinity(), false,
                !(lights_.around && settings_.environment.background)};
    }
    // Where nothing is.
    [[nodiscard]] glm::dvec3 behind(const Ray& ray) const {
        const settings::Environment& environment = settings_.environment;
        return lights_.around && environment.background
                   ? radianceFrom(*lights_.around, ray.direction,
                                  static_cast<double>(environment.blur))
                   : glm::dvec3(0); // its own colour is no radiance
    }
    [[nodiscard]] PlanePoint meet(const VisibleTriangle& visible, uint32_t x, uint32_t y) const {
        const auto& primitive = primitiveOf(scene_, visible.instance, visible.primitive);
        return meetPlane(rays_.through(x, y), placedTriangle(placements_[visible.instance],
                                                             primitive, visible.triangle));
    }
    [[nodiscard]] glm::dvec3 shadeHit(const PixelHit& hit, const VisibleTriangle& visible) const {
        const auto& primitive = primitiveOf(scene_, visible.instance, visible.primitive);
        const auto point =
            surfaceAt(rays_, hit, placements_[visible.instance], primitive, visible.triangle);
        return radiance(materials_.at(primitive.material, point), model_, lights_, open_);
    }

    const scene::Scene& scene_;
    const LightWay way_;
    const settings::ViewSettings& settings_;
    const Visibility& visibility_;
    const PixelRays rays_;
    const Model model_;
    const Lights lights_;
    const Medium medium_;
    const std::vector<Placement> placements_;
    const Materials materials_;
    const BlendedSurfaces layered_;      // what is behind shows through them
    std::optional<TriangleTree> traced_; // all; none: no light passes anything
    std::optional<Occluders> occluders_; // none: no light has shadows
    Open open_;
};

// Empty where every triangle exists.
std::string
findFault(const scene::Scene& scene, const settings::Size& size, const Visibility& visibility) {
    const auto text = [](uint32_t value) { return std::to_string(value); };
    if (visibility.width_px != size.width_px || visibility.height_px != size.height_px ||
        visibility.pixels.size() != size_t{size.width_px} * size.height_px) {
        return "the visibility is " + text(visibility.width_px) + "x" + text(visibility.height_px) +
               ", the picture " + text(size.width_px) + "x" + text(size.height_px);
    }
    for (const auto& pixel : visibility.pixels) {
        if (pixel.instance == VisibleTriangle::kNothing) {
            continue;
        }
        const bool placed = pixel.instance < scene.instances.size();
        const auto* mesh = placed ? &scene.meshes[scene.instances[pixel.instance].mesh] : nullptr;
        if (mesh == nullptr || pixel.primitive >= mesh->primitives.size() ||
            3 * size_t{pixel.triangle} >= mesh->primitives[pixel.primitive].indices.size()) {
            return "the visibility names triangle " + text(pixel.triangle) + " of primitive " +
                   text(pixel.primitive) + " of instance " + text(pixel.instance) +
                   ", which the scene does not have";
        }
    }
    return {};
}

} // namespace

Result<LinearImage> shade(const scene::Scene& scene,
                          const settings::ViewSettings& settings,
                          double time_s,
                          const Visibility& visibility,
                          LightWay way) {
    if (const auto fault = findFault(scene, settings.size, visibility); !fault.empty()) {
        return Error{ErrorCode::kInvalidArgument, fault};
    }
    if (settings.environment.present() && !surroundingsFor(scene, settings.environment)) {
        return Error{ErrorCode::kInvalidArgument,
                     "the settings ask for a panorama, which the scene does not have"};
    }
    const Shader shader(scene, settings, time_s, visibility, way);
    LinearImage image{settings.size.width_px, settings.size.height_px, {}};
    image.rgb.resize(visibility.pixels.size() * 3);
    std::atomic<uint32_t> next_row{0};
    const auto work = [&] {
        for (uint32_t y = next_row++; y < image.height_px; y = next_row++) {
            for (uint32_t x = 0; x < image.width_px; ++x) {
                const glm::vec3 color(shader.pixel(x, y));
                float* rgb = &image.rgb[3 * (size_t{y} * image.width_px + x)];
                rgb[0] = color.x;
                rgb[1] = color.y;
                rgb[2] = color.z;
            }
        }
    };
    std::vector<std::jthread> others;
    for (uint32_t i = 1; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
        others.emplace_back(work);
    }
    work();
    others.clear(); // joins
    return image;
}

} // namespace froxel::reference
