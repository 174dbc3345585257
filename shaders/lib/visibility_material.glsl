// Materials where no rasteriser hands them on: of this invocation's pixel. Textures are sampled by
// the gradients of the pixel's triangle.
#ifdef FROXEL_BINDLESS
layout(set = 3, binding = 0) uniform sampler2D scene_textures[]; // [material][kMaterialSlots]
#define slotTexture(slot)                                                                          \
    scene_textures[nonuniformEXT(visible_material * kMaterialSlots + slot##_slot)]
#else
// One material a dispatch.
#define DECLARE_SLOT(number, name, colour)                                                         \
    layout(set = 3, binding = 1 + number) uniform sampler2D name##_texture;
FROXEL_SURFACE_SLOTS(DECLARE_SLOT)
#ifdef FROXEL_LAYERED
FROXEL_LAYER_SLOTS(DECLARE_SLOT)
#endif
#define slotTexture(slot) slot##_texture
#endif

// The pixel's triangle: change towards the next pixel right and down.
struct Gradients {
    vec3 position_dx;
    vec3 position_dy;
    vec2 uv0_dx;
    vec2 uv0_dy;
    vec2 uv1_dx;
    vec2 uv1_dy;
};

uint visible_material;
Gradients gradients;
#define material materials[visible_material]

vec2 uvGradient(UvTransform t, vec2 uv0, vec2 uv1) {
    if (!hasMaterial(kMaterialUvTransform)) {
        return uv0;
    }
    vec2 uv = t.texcoord == 0u ? uv0 : uv1;
    return vec2(dot(t.row0.xy, uv), dot(t.row1.xy, uv));
}

#define uvDx(v, t) uvGradient(t, gradients.uv0_dx, gradients.uv1_dx)
#define uvDy(v, t) uvGradient(t, gradients.uv0_dy, gradients.uv1_dy)
#define positionDx(position) gradients.position_dx
#define positionDy(position) gradients.position_dy
#define sampleMaterial(slot, v)                                                                    \
    textureGrad(slotTexture(slot), slotUv(v, material.uv[slot##_slot]),                            \
                uvDx(v, material.uv[slot##_slot]), uvDy(v, material.uv[slot##_slot]))
