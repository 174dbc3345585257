// Writes small GLB files into a folder, one for each feature of materials and lights:
//   feature_scenes FOLDER
#include "gltf_writer/glb_writer.h"
#include "support/shapes.h"

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace froxel::test {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr uint32_t kRings = 40; // of a sphere
constexpr uint32_t kSide = 128; // of an image, pixels

glm::dmat4 at(double x, double y, double z = 0) {
    return glm::translate(glm::dmat4(1), dvec3(x, y, z));
}

scene::Material painted(const vec3& color, float metallic, float roughness) {
    scene::Material material;
    material.base_color = vec4(color, 1);
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

// Spheres side by side, from the origin to the right.
void addRow(SceneMaker& maker, const std::vector<scene::Material>& materials, double y = 0) {
    for (size_t i = 0; i < materials.size(); ++i) {
        maker.add(sphere(0.45F, kRings, maker.add(materials[i])), at(static_cast<double>(i), y));
    }
}

// A unit square that faces +Z; its texture coordinates run from 0 to 1, v downwards as glTF has it.
scene::Primitive pane(uint32_t material, uint32_t cells = 1) {
    scene::Primitive p = quad({-0.5F, -0.5F, 0}, {1, 0, 0}, {0, 1, 0}, cells, material);
    for (vec2& uv : p.uv0) {
        uv = vec2(uv.x / 4, 1 - uv.y / 4);
    }
    return p;
}

// Adds an image of kSide x kSide pixels and a texture of it; colorAt(uv), 0..1 each as stored.
template <class ColorAt>
uint32_t
addTexture(scene::Scene& scene, const ColorAt& colorAt, const scene::Sampler& sampler = {}) {
    scene::Image image{"", kSide, kSide, {}};
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            const vec4 color = colorAt((vec2(x, y) + 0.5F) / static_cast<float>(kSide));
            for (int c = 0; c < 4; ++c) {
                image.rgba8.own().push_back(static_cast<std::byte>(std::lround(color[c] * 255)));
            }
        }
    }
    scene.images.push_back(std::move(image));
    scene.samplers.push_back(sampler);
    scene.textures.push_back({static_cast<uint32_t>(scene.images.size() - 1),
                              static_cast<uint32_t>(scene.samplers.size() - 1)});
    return static_cast<uint32_t>(scene.textures.size() - 1);
}

// Squares in shades, of which none is another turned or mirrored.
vec4 checks(const vec2& uv) {
    const bool dark = (static_cast<int>(uv.x * 8) + static_cast<int>(uv.y * 8)) % 2 == 1;
    const vec3 shade(0.3F + 0.6F * uv.x, 0.3F + 0.6F * uv.y, 0.4F);
    return {dark ? shade * 0.5F : shade, 1};
}

scene::Scene metallicRoughness() {
    SceneMaker maker;
    for (const int row : {0, 1, 2}) {
        std::vector<scene::Material> materials;
        for (const float roughness : {0.1F, 0.25F, 0.4F, 0.6F, 0.8F, 1.0F}) {
            materials.push_back(
                painted({0.8F, 0.4F, 0.2F}, 0.5F * static_cast<float>(row), roughness));
        }
        addRow(maker, materials, row);
    }
    return maker.scene;
}

scene::Scene ior() {
    std::vector<scene::Material> materials;
    for (const float ior : {1.0F, 1.33F, 1.5F, 1.8F, 2.4F, 4.0F}) {
        materials.push_back(painted({0.1F, 0.15F, 0.3F}, 0, 0.3F));
        materials.back().ior = ior;
    }
    SceneMaker maker;
    addRow(maker, materials);
    return maker.scene;
}

scene::Scene specular() {
    SceneMaker maker;
    std::vector<scene::Material> strengths;
    std::vector<scene::Material> colors;
    for (const float share : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
        strengths.push_back(painted({0.1F, 0.15F, 0.3F}, 0, 0.3F));
        strengths.back().specular = share;
        colors.push_back(painted({0.1F, 0.15F, 0.3F}, 0, 0.3F));
        colors.back().specular_color = vec3(4, 4 - 4 * share, 4 * share);
    }
    addRow(maker, strengths);
    addRow(maker, colors, 1);
    return maker.scene;
}

// A row of spheres, each with more of it.
template <class Give>
scene::Scene lobes(const vec3& color, float metallic, float roughness, const Give& give) {
    std::vector<scene::Material> materials;
    for (const float share : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
        materials.push_back(painted(color, metallic, roughness));
        give(materials.back(), share);
    }
    SceneMaker maker;
    addRow(maker, materials);
    return maker.scene;
}

scene::Scene coat() {
    return lobes({0.6F, 0.1F, 0.1F}, 0, 0.6F, [](scene::Material& m, float share) {
        m.coat = {.strength = 1, .roughness = 0.1F + 0.6F * share};
    });
}

scene::Scene sheen() {
    return lobes({0.1F, 0.05F, 0.2F}, 0, 0.9F, [](scene::Material& m, float share) {
        m.sheen = {.color = {0.9F, 0.6F, 0.9F}, .roughness = 0.2F + 0.8F * share};
    });
}

// Along circles of latitude; coordinates and tangents are the file's.
scene::Scene anisotropy() {
    scene::Scene made = lobes({0.8F, 0.7F, 0.5F}, 1, 0.35F, [](scene::Material& m, float share) {
        m.anisotropy = {.strength = share};
    });
    for (scene::Mesh& mesh : made.meshes) {
        for (scene::Primitive& p : mesh.primitives) {
            p.uv0.clear();
            for (const vec3& n : p.normals) {
                const vec2 across(n.z, -n.x);
                const vec2 along = glm::length(across) > 0 ? glm::normalize(across) : vec2(1, 0);
                p.tangents.emplace_back(along.x, 0, along.y, 1);
                p.uv0.emplace_back(0.5F + std::atan2(n.z, n.x) / 6.2831853F, 0.5F - 0.5F * n.y);
            }
        }
    }
    return made;
}

scene::Scene iridescence() {
    return lobes({0.1F, 0.1F, 0.1F}, 0, 0.25F, [](scene::Material& m, float share) {
        m.film = {.strength = 1, .ior = 1.5F, .most_nm = 150 + 500 * share};
    });
}

// Opaque, masked and blended panes before a wall; of the last two blended ones one is behind the
// other.
scene::Scene alphaModes() {
    SceneMaker maker;
    const uint32_t checked = addTexture(maker.scene, checks);
    const uint32_t disc = addTexture(maker.scene, [](const vec2& uv) {
        return vec4(0.9F, 0.8F, 0.3F,
                    glm::clamp(1.5F - 2.5F * glm::distance(uv, vec2(0.5F)), 0.0F, 1.0F));
    });
    scene::Material wall = painted(vec3(1), 0, 1);
    wall.base_color_texture.texture = checked;
    maker.add(pane(maker.add(wall)), at(1.5, 0, -0.6) * glm::scale(glm::dmat4(1), dvec3(5)));
    scene::Material material = painted(vec3(1), 0, 0.6F);
    material.base_color_texture.texture = disc;
    const std::array modes = {scene::AlphaMode::kOpaque, scene::AlphaMode::kMask,
                              scene::AlphaMode::kBlend};
    for (size_t i = 0; i < modes.size(); ++i) {
        material.alpha_mode = modes[i];
        maker.add(pane(maker.add(material)), at(1.1 * static_cast<double>(i), 0));
    }
    scene::Material glass = painted({0.2F, 0.5F, 0.9F}, 0, 0.3F);
    glass.alpha_mode = scene::AlphaMode::kBlend;
    glass.base_color.w = 0.5F;
    maker.add(pane(maker.add(glass)), at(3.3, 0));
    glass.base_color = vec4(0.9F, 0.3F, 0.2F, 0.5F);
    maker.add(pane(maker.add(glass)), at(3.6, 0.3, 0.3));
    return maker.scene;
}

// A row of spheres of glass, each with more of something, before a wall.
template <class Give>
scene::Scene glasses(const Give& give) {
    scene::Scene made = lobes(vec3(1), 0, 0, [&](scene::Material& m, float share) {
        m.transmission.strength = 1;
        give(m, share);
    });
    SceneMaker maker;
    maker.scene = std::move(made);
    scene::Material wall = painted(vec3(1), 0, 1);
    wall.base_color_texture.texture = addTexture(maker.scene, checks);
    maker.add(pane(maker.add(wall)), at(2, 0, -1) * glm::scale(glm::dmat4(1), dvec3(6)));
    return maker.scene;
}

scene::Scene transmission() {
    return glasses([](scene::Material& m, float share) {
        m.base_color = vec4(1, 1 - 0.4F * share, 1 - 0.6F * share, 1);
        m.roughness = 0.6F * share;
    });
}

scene::Scene volume() {
    return glasses([](scene::Material& m, float share) {
        m.ior = 1 + share;
        m.volume = {.attenuation_color = {0.3F, 0.8F, 0.6F},
                    .attenuation_m = 1,
                    .thickness_m = 0.2F + 0.6F * share};
    });
}

scene::Scene dispersion() {
    return glasses([](scene::Material& m, float share) {
        m.ior = 1.6F;
        m.volume.thickness_m = 0.7F;
        m.transmission.dispersion = 5 * share;
    });
}

scene::Scene vertexColors() {
    SceneMaker maker;
    scene::Primitive p = pane(maker.add(painted({1, 0.8F, 0.8F}, 0, 0.7F)), 4);
    for (const vec2& uv : p.uv0) {
        p.colors.emplace_back(uv.x, uv.y, 1 - uv.x * uv.y, 1);
    }
    maker.add(p);
    return maker.scene;
}

// Offset, rotation, scale, all of them, and the three ways to wrap.
scene::Scene textureTransform() {
    using scene::Wrap;
    SceneMaker maker;
    const auto add = [&](const scene::TextureSlot& transform, Wrap u, Wrap v, double x, double y) {
        scene::Material material = painted(vec3(1), 0, 0.9F);
        material.base_color_texture = transform;
        material.base_color_texture.texture = addTexture(maker.scene, checks, {u, v});
        maker.add(pane(maker.add(material)), at(1.1 * x, 1.1 * y));
    };
    const Wrap repeat = Wrap::kRepeat;
    add({.offset = {0.25F, 0.5F}}, repeat, repeat, 0, 1);
    add({.rotation_rad = 0.5F}, repeat, repeat, 1, 1);
    add({.scale = {2, 0.5F}}, repeat, repeat, 2, 1);
    const scene::TextureSlot all{
        .offset = {-0.4F, 0.1F}, .rotation_rad = -0.7F, .scale = {2.5F, 1.5F}};
    add(all, repeat, repeat, 0, 0);
    add(all, Wrap::kMirroredRepeat, repeat, 1, 0);
    add(all, Wrap::kClampToEdge, Wrap::kMirroredRepeat, 2, 0);
    return maker.scene;
}

scene::Scene unlit() {
    SceneMaker maker;
    scene::Material material = painted({0.9F, 0.5F, 0.2F}, 0, 1);
    material.unlit = true;
    maker.add(pane(maker.add(material)), at(0, 0));
    material.base_color = vec4(1);
    material.base_color_texture.texture = addTexture(maker.scene, checks);
    maker.add(pane(maker.add(material)), at(1.1, 0));
    material.unlit = false;
    maker.add(pane(maker.add(material)), at(2.2, 0));
    return maker.scene;
}

scene::Scene emissiveStrength() {
    std::vector<scene::Material> materials;
    for (const float strength : {0.0F, 0.25F, 1.0F, 4.0F, 16.0F}) {
        materials.push_back(painted({0.2F, 0.2F, 0.2F}, 0, 0.8F));
        materials.back().emissive = vec3(1, 0.4F, 0.1F) * strength;
    }
    SceneMaker maker;
    addRow(maker, materials);
    return maker.scene;
}

// Bumps with the tangents of the file, and without.
scene::Scene normalMap() {
    SceneMaker maker;
    scene::Material material = painted({0.7F, 0.7F, 0.75F}, 0, 0.4F);
    material.normal_texture.texture = addTexture(maker.scene, [](const vec2& uv) {
        const vec2 turn = 8 * std::numbers::pi_v<float> * uv;
        const vec2 slope(std::cos(turn.x) * std::sin(turn.y), std::sin(turn.x) * std::cos(turn.y));
        // v runs down, the bitangent up.
        return vec4(glm::normalize(vec3(-0.6F * slope.x, 0.6F * slope.y, 1)) * 0.5F + 0.5F, 1);
    });
    const uint32_t bumpy = maker.add(material);
    scene::Primitive p = pane(bumpy);
    maker.add(p);
    p.tangents.assign(p.positions.size(), vec4(1, 0, 0, 1));
    maker.add(p, at(1.1, 0));
    return maker.scene;
}

// The file's own lights over a floor: a point that ends, a soft spot, a sun.
scene::Scene punctual() {
    SceneMaker maker;
    const uint32_t floor = maker.add(painted(vec3(0.8F), 0, 0.7F));
    maker.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8, floor));
    maker.add(sphere(0.4F, kRings, floor), at(0, 0.4));
    maker.point({-1, 0.8, 0.5}, 2, 1.5F);
    maker.spot({1.2, 1.5, 0.6}, {0, -1, -0.2}, 0, 10, 30);
    maker.scene.lights.back().intensity = 4;
    maker.sun({0.3, -1, -0.4});
    maker.scene.lights.back().intensity = 0.5F;
    return maker.scene;
}

struct Feature {
    const char* name;
    scene::Scene (*make)();
};

constexpr std::array kFeatures = {
    Feature{"metallic_roughness", metallicRoughness},
    Feature{"ior", ior},
    Feature{"specular", specular},
    Feature{"coat", coat},
    Feature{"sheen", sheen},
    Feature{"anisotropy", anisotropy},
    Feature{"iridescence", iridescence},
    Feature{"transmission", transmission},
    Feature{"volume", volume},
    Feature{"dispersion", dispersion},
    Feature{"alpha_modes", alphaModes},
    Feature{"vertex_colors", vertexColors},
    Feature{"texture_transform", textureTransform},
    Feature{"unlit", unlit},
    Feature{"emissive_strength", emissiveStrength},
    Feature{"normal_map", normalMap},
    Feature{"punctual", punctual},
};

} // namespace
} // namespace froxel::test

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: feature_scenes FOLDER\n", stderr);
        return 2;
    }
    for (const auto& feature : froxel::test::kFeatures) {
        const auto path = std::filesystem::path(argv[1]) / (std::string(feature.name) + ".glb");
        const auto written = froxel::gltf_writer::writeGlb(feature.make(), path);
        if (!written) {
            std::fprintf(stderr, "%s\n", written.error().message.c_str());
            return 1;
        }
    }
    return 0;
}
