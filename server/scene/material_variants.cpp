#include "scene/material_variants.h"

#include <algorithm>

namespace froxel::scene {

Scene inMaterialVariant(Scene scene, uint32_t number) {
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            const auto found =
                std::ranges::find_if(primitive.variant_materials, [&](const VariantMaterial& of) {
                    return of.variant + 1 == number;
                });
            if (found != primitive.variant_materials.end()) {
                primitive.material = found->material;
            }
            primitive.variant_materials.clear();
        }
    }
    scene.material_variants.clear();
    scene.material_variant = 0;
    return scene;
}

} // namespace froxel::scene
