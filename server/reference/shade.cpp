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
#include "settings/environment.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <set>
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

// Those of pixels, of what is blended and, where there are shadows, of what is cut out.
std::vector<uint32_t>
visibleMaterials(const scene::Scene& scene, const Visibility& visibility, bool shadows) {
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
        if (mode == scene::AlphaMode::kBlend || (shadows && mode == scene::AlphaMode::kMask)) {
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
           const Visibility& visibility)
        : scene_(scene), settings_(settings), visibility_(visibility),
          rays_(settings.camera, settings.size), model_(modelOf(settings)),
          lights_(lightsAt(scene, settings, time_s)),
          medium_(settings.fog, settings.camera, lights_, open_),
          placements_(placementsOf(scene, settings.camera.eye_world)),
          materials_(scene,
                     visibleMaterials(scene, visibility, settings.shadows.light_count > 0),
                     visibility.filter),
          blended_(scene, placements_, settings.camera, settings.size) {
        if (settings.shadows.light_count > 0) {
            occluders_.emplace(scene, placements_, materials_);
            open_ = [this](const glm::dvec3& from, const glm::dvec3& to) {
                return !occluders_->between(from, to);
            };
        }
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    [[nodiscard]] glm::dvec3 pixel(uint32_t x, uint32_t y) const {
        const auto& visible = visibility_.pixels[size_t{y} * visibility_.width_px + x];
        const Ray ray = rays_.through(x, y);
        glm::dvec3 color = behind(ray);
        double distance = std::numeric_limits<double>::infinity();
        if (visible.instance != VisibleTriangle::kNothing) {
            const PixelHit hit{x, y, meet(visible, x, y)};
            distance = hit.point.distance;
            color = shadeHit(hit, visible);
            if (settings_.renderer == settings::Renderer::kToonCompute) {
                const double norm = glm::length(color);
                const double shade =
                    toonBand(settings_.toon.bands, toonRamp(settings_.toon_compute, norm), 0);
                color *= norm > 0 ? shade / norm : 0.0;
            }
        }
        color = medium_.seenThrough(color, ray, distance);
        return withBlended({color, distance, isUnlit(visible)}, {x, y}, ray);
    }

  private:
    [[nodiscard]] bool isUnlit(const VisibleTriangle& visible) const {
        return visible.instance != VisibleTriangle::kNothing &&
               scene_.materials[primitiveOf(scene_, visible.instance, visible.primitive).material]
                   .unlit;
    }
    // The solid picture at a pixel.
    struct Behind {
        glm::dvec3 color;
        double distance;
        bool unlit; // a colour of the display; so is then what is blended over it
    };
    [[nodiscard]] glm::dvec3
    withBlended(const Behind& behind, const glm::uvec2& at, const Ray& ray) const {
        glm::dvec3 sum(0);
        double left = 1;
        for (const auto& layer : blended_.at(at.x, at.y)) {
            if (layer.point.distance <= behind.distance) {
                double alpha = 1;
                const glm::dvec3 over =
                    shadeHit({at.x, at.y, layer.point},
                             {layer.instance, layer.primitive, layer.triangle}, &alpha);
                sum = glm::mix(sum, medium_.seenThrough(over, ray, layer.point.distance), alpha);
                left *= 1 - alpha;
            }
        }
        if (!behind.unlit || left == 1) {
            return sum + left * behind.color;
        }
        const glm::dvec3 shown = toneMapped(
            sum / (1 - left), static_cast<double>(settings_.exposure), settings_.tone_map);
        return glm::mix(glm::min(shown, glm::dvec3(1)), behind.color, left);
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
    [[nodiscard]] glm::dvec3
    shadeHit(const PixelHit& hit, const VisibleTriangle& visible, double* alpha = nullptr) const {
        const auto& primitive = primitiveOf(scene_, visible.instance, visible.primitive);
        const auto point =
            surfaceAt(rays_, hit, placements_[visible.instance], primitive, visible.triangle);
        const Surface surface = materials_.at(primitive.material, point);
        if (alpha != nullptr) {
            *alpha = surface.alpha;
        }
        return radiance(surface, model_, lights_, open_);
    }

    const scene::Scene& scene_;
    const settings::ViewSettings& settings_;
    const Visibility& visibility_;
    const PixelRays rays_;
    const Model model_;
    const Lights lights_;
    const Medium medium_;
    const std::vector<Placement> placements_;
    const Materials materials_;
    const BlendedSurfaces blended_;
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
                          const Visibility& visibility) {
    if (const auto fault = findFault(scene, settings.size, visibility); !fault.empty()) {
        return Error{ErrorCode::kInvalidArgument, fault};
    }
    if (settings.environment.present() && !surroundingsFor(scene, settings.environment)) {
        return Error{ErrorCode::kInvalidArgument,
                     "the settings ask for a panorama, which the scene does not have"};
    }
    const Shader shader(scene, settings, time_s, visibility);
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
