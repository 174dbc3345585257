#include "reference/material.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {
namespace {

// KHR_texture_transform, of a coordinate; `offset` is left out for changes.
glm::dvec2 transformed(const scene::TextureSlot& slot, const glm::dvec2& uv, bool offset) {
    const double c = std::cos(static_cast<double>(slot.rotation_rad));
    const double s = std::sin(static_cast<double>(slot.rotation_rad));
    const glm::dvec2 scaled = uv * glm::dvec2(slot.scale);
    const glm::dvec2 rotated(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
    return offset ? rotated + glm::dvec2(slot.offset) : rotated;
}

// Stated here too, so that the table of slots does not speak for itself.
bool isColor(uint32_t slot) {
    return slot == io::base_color_slot || slot == io::emissive_slot ||
           slot == io::specular_color_slot || slot == io::sheen_color_slot ||
           slot == io::diffuse_transmission_color_slot;
}

struct TangentFrame {
    glm::dvec3 tangent{0};   // where u grows
    glm::dvec3 bitangent{0}; // where v falls: glTF's green channel points up in the image
    bool known = false;
};

// Gradients of u and v over the triangle as seen by the interpolated normal (Mikkelsen 2020), the
// longer one made unit.
TangentFrame gradientFrame(const SurfacePoint& p, const scene::TextureSlot& slot) {
    const UvPlane& uv = p.uv[slot.texcoord == 0 ? 0 : 1];
    const glm::dvec2 change1 = transformed(slot, uv.edge1, false);
    const glm::dvec2 change2 = transformed(slot, uv.edge2, false);
    const glm::dvec3 against1 = glm::cross(p.triangle.edge2, p.normal);
    const glm::dvec3 against2 = glm::cross(p.normal, p.triangle.edge1);
    const double area = glm::dot(p.normal, glm::cross(p.triangle.edge1, p.triangle.edge2));
    TangentFrame frame;
    frame.tangent = against1 * change1.x + against2 * change2.x;
    frame.bitangent = -(against1 * change1.y + against2 * change2.y);
    const double longest = std::max(glm::length(frame.tangent), glm::length(frame.bitangent));
    frame.known = longest > 0;
    if (frame.known) {
        const double scale = (area < 0 ? -1 : 1) / longest;
        frame.tangent *= scale;
        frame.bitangent *= scale;
    }
    return frame;
}

// By the file's tangent where it has one.
TangentFrame tangentFrame(const SurfacePoint& p, const scene::TextureSlot& slot) {
    if (p.tangent.w == 0) {
        return gradientFrame(p, slot);
    }
    TangentFrame frame;
    frame.tangent = glm::dvec3(p.tangent);
    frame.bitangent = glm::cross(p.normal, frame.tangent) * p.tangent.w;
    frame.known = true;
    return frame;
}

// strength, thickness: shares of the material's, from textures.
Transmission
transmissionOf(const scene::Material& m, double roughness, double strength, double thickness) {
    const double ior = m.ior == 0 ? 1e6 : static_cast<double>(m.ior); // infinite
    Transmission t{.strength = static_cast<double>(m.transmission.strength) * strength,
                   .roughness = roughness * std::clamp(2 * ior - 2, 0.0, 1.0),
                   .ior = ior,
                   .dispersion = static_cast<double>(m.transmission.dispersion),
                   .thickness = static_cast<double>(m.volume.thickness_m) * thickness};
    if (m.volume.attenuation_m > 0) {
        t.attenuation = glm::pow(glm::dvec3(m.volume.attenuation_color),
                                 glm::dvec3(1 / static_cast<double>(m.volume.attenuation_m)));
    }
    return t;
}

} // namespace

Materials::Materials(const scene::Scene& scene,
                     std::span<const uint32_t> used,
                     const TextureFilter& filter)
    : scene_(scene), filter_(filter) {
    for (const uint32_t index : used) {
        const scene::Material& m = scene.materials[index];
        Look look;
        const auto slots = textureSlots(m);
        for (uint32_t i = 0; i < slots.size(); ++i) {
            if (!m.unlit || i == io::base_color_slot) {
                look[i] = slot(*slots[i], isColor(i));
            }
        }
        looks_.emplace(index, look);
    }
}

Materials::Slot Materials::slot(const scene::TextureSlot& settings, bool srgb) {
    if (settings.texture == scene::kNone) {
        return {};
    }
    const scene::Texture& texture = scene_.textures[settings.texture];
    auto& chain = chains_[{texture.image, srgb}];
    if (!chain) {
        chain = std::make_unique<MipChain>(scene_.images[texture.image], srgb);
    }
    const auto sampler =
        texture.sampler != scene::kNone ? scene_.samplers[texture.sampler] : scene::Sampler{};
    return {chain.get(), sampler, settings};
}

glm::dvec4 Materials::sample(const Slot& slot, const SurfacePoint& point) const {
    if (slot.chain == nullptr) {
        return glm::dvec4(1);
    }
    const UvPlane& uv = point.uv[slot.settings.texcoord == 0 ? 0 : 1];
    const Footprint footprint{transformed(slot.settings, uv.at(point.weights), true),
                              transformed(slot.settings, uv.change(point.weights_dx), false),
                              transformed(slot.settings, uv.change(point.weights_dy), false)};
    return slot.chain->sample(slot.sampler, footprint, filter_);
}

// The back of a double-sided surface has the front's normal, normal map and all, reversed.
glm::dvec3 Materials::normalAt(const scene::Material& material,
                               const Slot& map,
                               float scale,
                               const SurfacePoint& point) const {
    const double facing = material.double_sided && !point.front ? -1 : 1;
    if (map.chain == nullptr) {
        return point.normal * facing;
    }
    glm::dvec3 bump = glm::dvec3(sample(map, point)) * 2.0 - 1.0;
    bump *= glm::dvec3(glm::dvec2(static_cast<double>(scale)), 1);
    const TangentFrame frame = tangentFrame(point, map.settings);
    if (!frame.known) {
        return point.normal * facing;
    }
    return glm::normalize(frame.tangent * bump.x + frame.bitangent * bump.y +
                          point.normal * bump.z) *
           facing;
}

Anisotropy Materials::anisotropyAt(const scene::Material& material,
                                   const Slot& map,
                                   const SurfacePoint& point) const {
    Anisotropy out{static_cast<double>(material.anisotropy.strength), glm::dvec3(0)};
    glm::dvec2 direction(1, 0);
    if (map.chain != nullptr) {
        const glm::dvec4 texel = sample(map, point);
        direction = glm::dvec2(texel) * 2.0 - 1.0;
        out.strength *= texel.z;
    }
    const double turn = static_cast<double>(material.anisotropy.rotation_rad);
    direction = {std::cos(turn) * direction.x - std::sin(turn) * direction.y,
                 std::sin(turn) * direction.x + std::cos(turn) * direction.y};
    const TangentFrame frame = tangentFrame(point, map.settings);
    if (frame.known) {
        const glm::dvec3 t = glm::length(frame.tangent) > 0
                                 ? glm::normalize(frame.tangent)
                                 : glm::cross(frame.bitangent, point.normal);
        const glm::dvec3 turned = glm::cross(point.normal, t);
        const double hand = glm::dot(turned, frame.bitangent) < 0 ? -1 : 1;
        out.direction = t * direction.x + turned * (hand * direction.y);
    }
    return out;
}

double Materials::alpha(uint32_t material, const SurfacePoint& point) const {
    const scene::Material& m = scene_.materials[material];
    return static_cast<double>(m.base_color.w) *
           sample(looks_.at(material)[io::base_color_slot], point).w * point.color.w;
}

void Materials::addLayers(const scene::Material& m,
                          const Look& look,
                          const SurfacePoint& point,
                          Surface& s) const {
    s.coat.strength = static_cast<double>(m.coat.strength) * sample(look[io::coat_slot], point).x;
    s.coat.roughness =
        static_cast<double>(m.coat.roughness) * sample(look[io::coat_roughness_slot], point).y;
    s.coat.normal = normalAt(m, look[io::coat_normal_slot], m.coat.normal_scale, point);
    s.sheen.color =
        glm::dvec3(m.sheen.color) * glm::dvec3(sample(look[io::sheen_color_slot], point));
    s.sheen.roughness =
        static_cast<double>(m.sheen.roughness) * sample(look[io::sheen_roughness_slot], point).w;
    s.film.strength = static_cast<double>(m.film.strength) * sample(look[io::film_slot], point).x;
    s.film.ior = static_cast<double>(m.film.ior);
    s.film.thickness_nm =
        std::lerp(static_cast<double>(m.film.least_nm), static_cast<double>(m.film.most_nm),
                  sample(look[io::film_thickness_slot], point).y);
}

Surface Materials::at(uint32_t material, const SurfacePoint& point) const {
    const scene::Material& m = scene_.materials[material];
    const Look& look = looks_.at(material);
    const glm::dvec4 base =
        glm::dvec4(m.base_color) * sample(look[io::base_color_slot], point) * point.color;
    const glm::dvec4 roughness = sample(look[io::metallic_roughness_slot], point);
    const double occlusion = sample(look[io::occlusion_slot], point).x;
    Surface s;
    s.position = point.position;
    s.normal = normalAt(m, look[io::normal_slot], m.normal_scale, point);
    s.to_eye = point.to_eye;
    s.base_color = glm::clamp(glm::dvec3(base), 0.0, 1.0);
    s.alpha = m.alpha_mode == scene::AlphaMode::kBlend ? std::clamp(base.w, 0.0, 1.0) : 1.0;
    s.roughness = static_cast<double>(m.roughness) * roughness.y;
    s.metallic = static_cast<double>(m.metallic) * roughness.z;
    s.occlusion = 1 + static_cast<double>(m.occlusion_strength) * (occlusion - 1);
    s.emissive = glm::dvec3(m.emissive) * glm::dvec3(sample(look[io::emissive_slot], point));
    s.unlit = m.unlit;
    const glm::dvec4 specular_color = sample(look[io::specular_color_slot], point);
    const double ior = static_cast<double>(m.ior);
    const double strength =
        static_cast<double>(m.specular) * sample(look[io::specular_slot], point).w;
    const glm::dvec3 head_on = glm::dvec3(m.specular_color) * glm::dvec3(specular_color) *
                               (std::pow(ior - 1, 2) / std::pow(ior + 1, 2));
    s.dielectric_f0 = glm::min(head_on, 1.0) * strength;
    s.dielectric_f90 = strength;
    if (m.glossiness_texture) {
        s.roughness = 1 - (1 - static_cast<double>(m.roughness)) * specular_color.w;
    }
    addLayers(m, look, point, s);
    s.diffuse_transmission = {
        static_cast<double>(m.diffuse_transmission.strength) *
            sample(look[io::diffuse_transmission_slot], point).w,
        glm::dvec3(m.diffuse_transmission.color) *
            glm::dvec3(sample(look[io::diffuse_transmission_color_slot], point))};
    if (m.volume.thickness_m > 0 && m.volume.attenuation_m > 0) { // Beer's law
        const double ways = static_cast<double>(m.volume.thickness_m) *
                            sample(look[io::thickness_slot], point).y /
                            static_cast<double>(m.volume.attenuation_m);
        s.diffuse_transmission.color *=
            glm::pow(glm::dvec3(m.volume.attenuation_color), glm::dvec3(ways));
    }
    if (transmits(m)) {
        s.transmission =
            transmissionOf(m, s.roughness, sample(look[io::transmission_slot], point).x,
                           sample(look[io::thickness_slot], point).y);
    }
    if (m.anisotropy.strength > 0) {
        s.anisotropy = anisotropyAt(m, look[io::anisotropy_slot], point);
    }
    return s;
}

} // namespace froxel::reference
