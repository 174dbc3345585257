#include "support/test_scenes.h"

#include "gltf/gltf_loader.h"
#include "support/places.h"
#include "support/quad.h"

#include <filesystem>

namespace froxel::test {

namespace {

using glm::vec3;

scene::Mesh box(uint32_t material) {
    scene::Mesh mesh{.name = "box", .primitives = {}};
    const vec3 x(1, 0, 0);
    const vec3 y(0, 1, 0);
    const vec3 z(0, 0, 1);
    mesh.primitives = {quad({0, 0, 1}, x, y, 4, material),  quad({1, 0, 0}, -x, y, 4, material),
                       quad({1, 0, 1}, -z, y, 4, material), quad({0, 0, 0}, z, y, 4, material),
                       quad({0, 1, 1}, x, -z, 4, material), quad({0, 0, 0}, x, z, 4, material)};
    return mesh;
}

// 32 x 32 texels: `f(x, y)` gives RGBA in 0..255.
template <class F>
scene::Image image(const char* name, F f) {
    scene::Image out{name, 32, 32, {}};
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            for (const int channel : f(x, y)) {
                out.rgba8.own().push_back(static_cast<std::byte>(channel));
            }
        }
    }
    return out;
}

void addTextures(scene::Scene& scene) {
    using Texel = std::array<int, 4>;
    scene.images.push_back(image("checks", [](int x, int y) {
        const bool on = ((x / 8) + (y / 8)) % 2 == 0;
        return on ? Texel{200, 190, 170, 255} : Texel{90, 60, 50, 255};
    }));
    scene.images.push_back(image("dents", [](int x, int y) {
        return Texel{128 + 40 * ((x % 8) - 4) / 4, 128 + 40 * ((y % 8) - 4) / 4, 240, 255};
    }));
    scene.images.push_back(image("holes", [](int x, int y) {
        const int dx = x % 16 - 8;
        const int dy = y % 16 - 8;
        return Texel{60, 140, 60, dx * dx + dy * dy < 30 ? 0 : 255};
    }));
    scene.samplers.push_back({});
    scene.textures = {{0, 0}, {1, 0}, {2, 0}};
}

void addMaterials(scene::Scene& scene) {
    scene::Material checks;
    checks.metallic = 0;
    checks.roughness = 0.6F;
    checks.base_color_texture.texture = 0;
    checks.normal_texture.texture = 1;
    scene::Material leaves;
    leaves.metallic = 0;
    leaves.roughness = 0.9F;
    leaves.alpha_mode = scene::AlphaMode::kMask;
    leaves.double_sided = true;
    leaves.base_color_texture.texture = 2;
    scene::Material glass;
    glass.metallic = 0;
    glass.roughness = 0.1F;
    glass.base_color = {0.6F, 0.8F, 0.9F, 0.3F};
    glass.alpha_mode = scene::AlphaMode::kBlend;
    glass.double_sided = true;
    scene::Material gold;
    gold.metallic = 1;
    gold.roughness = 0.3F;
    gold.base_color = {1.0F, 0.8F, 0.4F, 1};
    scene::Material lamp;
    lamp.metallic = 0;
    lamp.emissive = {2.0F, 1.5F, 1.0F};
    scene.materials = {checks, leaves, glass, gold, lamp};
}

void place(scene::Scene& scene, uint32_t mesh, const glm::dvec3& at, const glm::dvec3& scale) {
    scene::Instance instance{.mesh = mesh, .world_from_object = glm::dmat4(1), .name = {}};
    for (int i = 0; i < 3; ++i) {
        instance.world_from_object[i][i] = scale[i];
    }
    instance.world_from_object[3] = glm::dvec4(at, 1);
    scene.instances.push_back(instance);
}

} // namespace

scene::Scene makeRoom() {
    scene::Scene scene;
    scene.name = "room";
    addTextures(scene);
    addMaterials(scene);
    scene.meshes = {{"floor", {quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}, 24, 0)}},
                    {"wall", {quad({-6, 0, -4}, {12, 0, 0}, {0, 6, 0}, 12, 0)}},
                    {"leaves", {quad({-3, 0, 1}, {2, 0, 0}, {0, 2, 0}, 1, 1)}},
                    {"glass", {quad({0, 0, 2}, {2, 0, 0}, {0, 2, 0}, 1, 2)}},
                    box(3),
                    box(4)};
    const glm::dvec3 one(1);
    for (uint32_t mesh = 0; mesh < 4; ++mesh) {
        place(scene, mesh, {0, 0, 0}, one);
    }
    place(scene, 3, {0.5, 0.3, -0.5}, one);
    place(scene, 4, {2, 0, 0}, {-1, 1.5, 2});
    place(scene, 4, {-2, 0, -2}, {1, 0.2, 1});
    place(scene, 5, {3, 2, -3}, {0.3, 0.3, 0.3});
    scene.bounds_world.add(glm::dvec3(-6, 0, -4));
    scene.bounds_world.add(glm::dvec3(6, 6, 6));
    scene.cameras = {{"front", settings::lookAt({0.5, 2.2, 7}, {0, 1, 0}, {0, 1, 0})},
                     {"low", settings::lookAt({-5, 0.4, 3}, {2, 1, -2}, {0, 1, 0})}};
    return scene;
}

void giveCoats(scene::Scene& room) {
    auto& floor = room.materials[0];
    floor.coat.strength = 1;
    floor.coat.roughness = 0.3F;
    floor.coat_normal_texture = {1, 0, {0.1F, 0.2F}, 0.3F, {0.5F, 0.5F}};
    auto& glass = room.materials[2];
    glass.coat.strength = 1;
    glass.coat.roughness = 0.5F;
    auto& wall = room.materials[3];
    wall.coat.strength = 0.5F;
    wall.coat.roughness = 0.8F;
    wall.coat_roughness_texture.texture = 0;
    auto& box = room.materials[4];
    box.coat.strength = 0.7F;
    box.coat.roughness = 0.4F;
    box.coat_texture.texture = 0;
}

void giveLobes(scene::Scene& room) {
    room.materials[0].sheen = {.color = {0.9F, 0.5F, 0.2F}, .roughness = 0.3F};
    room.materials[2].sheen = {.color = {0.2F, 0.4F, 1}, .roughness = 0.6F};
    room.materials[3].sheen = {.color = {1, 1, 1}, .roughness = 1};
    room.materials[3].sheen_color_texture.texture = 0;
    room.materials[4].sheen = {.color = {0.4F, 0.8F, 0.4F}, .roughness = 0.8F};
    room.materials[4].sheen_roughness_texture.texture = 2;
    room.materials[3].film = {.strength = 0.8F, .ior = 1.4F, .least_nm = 200, .most_nm = 600};
    room.materials[3].film_thickness_texture.texture = 0;
    room.materials[0].anisotropy = {.strength = 0.9F, .rotation_rad = 0.5F};
    room.materials[2].diffuse_transmission = {.color = {0.3F, 0.9F, 0.4F}, .strength = 0.5F};
    room.materials[3].diffuse_transmission = {.color = glm::vec3(1), .strength = 0.8F};
    room.materials[3].diffuse_transmission_color_texture.texture = 0;
    room.materials[4].anisotropy.strength = 0.7F;
    room.materials[4].anisotropy_texture.texture = 1;
}

std::optional<scene::Scene> loadSponza() {
    const auto path = sponzaPath();
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    auto scene = gltf::load(path);
    return scene ? std::optional(std::move(*scene)) : std::nullopt;
}

} // namespace froxel::test
