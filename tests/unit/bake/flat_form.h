// A scene as the bytes that a reader hands back.
#pragma once

#include "bake/flat_scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace froxel::bake {

[[nodiscard]] inline std::vector<std::byte> flat(const scene::Scene& scene) {
    std::vector<std::byte> bytes;
    writeFlat(scene, [&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
    });
    return bytes;
}

} // namespace froxel::bake
