// Scenes as the bytes that a reader hands back.
#pragma once

#include "bake/flat_scene.h"
#include "scene/motion.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace froxel::bake {

[[nodiscard]] inline std::vector<std::byte> flat(const scene::Scene& scene,
                                                 std::span<const std::byte> pool = {}) {
    std::vector<std::byte> bytes;
    writeFlat(
        scene,
        [&](std::span<const std::byte> part) {
            bytes.insert(bytes.end(), part.begin(), part.end());
        },
        pool);
    return bytes;
}

// A triangle with a texture and levels, a camera, lights, and something that moves.
[[nodiscard]] inline scene::Scene smallScene() {
    scene::Scene scene;
    scene.name = "small";
    scene.images.push_back({"image", 2, 1, std::vector<std::byte>(8), {std::vector<std::byte>(4)}});
    scene.samplers.emplace_back().wrap_u = scene::Wrap::kClampToEdge;
    scene.textures.push_back({0, 0});
    scene.materials.emplace_back().base_color_texture.texture = 0;
    scene.material_variants = {"red"};
    scene.material_variant = 1;
    auto& primitive = scene.meshes.emplace_back().primitives.emplace_back();
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    primitive.variant_materials = {{0, 0}};
    for (const auto& position : primitive.positions) {
        primitive.bounds.add(position);
    }
    scene.instances.emplace_back().name = "instance";
    scene.cameras.emplace_back().name = "camera";
    scene.lights.emplace_back().type = scene::LightType::kSpot;
    scene.bounds_world = {{0, 0, 0}, {1, 1, 0}};
    scene::Motion motion;
    motion.nodes.emplace_back();
    motion.clips.push_back(
        {"clip", 1, {{scene::Interpolation::kLinear, 3, {0, 1}, {0, 0, 0, 1, 1, 1}}}, {{}}});
    motion.instances.push_back({0, 0, glm::dmat4(1), scene::kNone});
    scene.motion = std::make_shared<const scene::Motion>(motion);
    scene.warnings.push_back({"CODE", scene::Severity::kInformation, "/nodes/0", "a line"});
    return scene;
}

} // namespace froxel::bake
