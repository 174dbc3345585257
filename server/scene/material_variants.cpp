#include "scene/material_variants.h"

#include <algorithm>

namespace froxel::scene {

uint32_t materialIn(uint32_t number, uint32_t own, std::span<const VariantMaterial> others) {
    const auto found = std::ranges::find_if(
        others, [&](const VariantMaterial& of) { return of.variant + 1 == number; });
    return found == others.end() ? own : found->material;
}

Scene inMaterialVariant(Scene scene, uint32_t number) {
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            primitive.material =
                materialIn(number, primitive.material, primitive.variant_materials);
            primitive.variant_materials.clear();
        }
    }
    scene.material_variants.clear();
    scene.material_variant = 0;
    return scene;
}

} // namespace froxel::scene
