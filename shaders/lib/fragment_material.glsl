// Set 1 of the fragment stage: a draw's material; textures and derivatives come from the quad.
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { Material material; };
#define DECLARE_SLOT(number, name, colour)                                                         \
    layout(set = 1, binding = 1 + number) uniform sampler2D name##_texture;
FROXEL_SURFACE_SLOTS(DECLARE_SLOT)
#ifdef FROXEL_LAYERED
FROXEL_LAYER_SLOTS(DECLARE_SLOT)
#endif

#define sampleMaterial(slot, v) texture(slot##_texture, slotUv(v, material.uv[slot##_slot]))
#define uvDx(v, t) dFdx(slotUv(v, t))
#define uvDy(v, t) dFdy(slotUv(v, t))
#define positionDx(position) dFdx(position)
#define positionDy(position) dFdy(position)
