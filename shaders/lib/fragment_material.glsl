// Set 1 of the fragment stage: a draw's material; textures and derivatives come from the quad.
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { Material material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
layout(set = 1, binding = 2) uniform sampler2D normal_texture;
layout(set = 1, binding = 3) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;
layout(set = 1, binding = 6) uniform sampler2D specular_texture;
layout(set = 1, binding = 7) uniform sampler2D specular_color_texture;
#ifdef FROXEL_LAYERED
layout(set = 1, binding = 8) uniform sampler2D coat_texture;
layout(set = 1, binding = 9) uniform sampler2D coat_roughness_texture;
layout(set = 1, binding = 10) uniform sampler2D coat_normal_texture;
#endif

#define sampleMaterial(slot, v, t) texture(slot##_texture, slotUv(v, t))
#define uvDx(v, t) dFdx(slotUv(v, t))
#define uvDy(v, t) dFdy(slotUv(v, t))
#define positionDx(position) dFdx(position)
#define positionDy(position) dFdy(position)
