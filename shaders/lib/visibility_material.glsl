// Materials where no rasteriser hands them on: of this invocation's pixel. Textures are sampled by
// the gradients of the pixel's triangle.
#ifdef FROXEL_BINDLESS
layout(set = 3, binding = 0) uniform sampler2D scene_textures[]; // [material][kTexturesOfMaterial]
const uint base_color_slot = 0u;
const uint normal_slot = 1u;
const uint metallic_roughness_slot = 2u;
const uint occlusion_slot = 3u;
const uint emissive_slot = 4u;
const uint specular_slot = 5u;
const uint specular_color_slot = 6u;
const uint coat_slot = 7u;
const uint coat_roughness_slot = 8u;
const uint coat_normal_slot = 9u;
#define slotTexture(slot)                                                                          \
    scene_textures[nonuniformEXT(visible_material * kTexturesOfMaterial + slot##_slot)]
#else
// One material a dispatch.
layout(set = 3, binding = 1) uniform sampler2D base_color_texture;
layout(set = 3, binding = 2) uniform sampler2D normal_texture;
layout(set = 3, binding = 3) uniform sampler2D metallic_roughness_texture;
layout(set = 3, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 3, binding = 5) uniform sampler2D emissive_texture;
layout(set = 3, binding = 6) uniform sampler2D specular_texture;
layout(set = 3, binding = 7) uniform sampler2D specular_color_texture;
#ifdef FROXEL_LAYERED
layout(set = 3, binding = 8) uniform sampler2D coat_texture;
layout(set = 3, binding = 9) uniform sampler2D coat_roughness_texture;
layout(set = 3, binding = 10) uniform sampler2D coat_normal_texture;
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
#define sampleMaterial(slot, v, t)                                                                 \
    textureGrad(slotTexture(slot), slotUv(v, t), uvDx(v, t), uvDy(v, t))
