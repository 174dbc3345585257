// Set 1 of the fragment stage: a draw's material; textures and derivatives come from the quad.
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { Material material; };
#define DECLARE_SLOT(number, name, colour)                                                         \
    layout(set = 1, binding = 1 + number) uniform sampler2D name##_texture;
FROXEL_SURFACE_SLOTS(DECLARE_SLOT)
#ifdef FROXEL_LAYERED
FROXEL_LAYER_SLOTS(DECLARE_SLOT)
#endif

// A GPU's implicit gradients depend in their last bits on which pixels of the quad the depth test
// leaves, so that a depth prepass would move one pixel in a million by a step of the texture filter
// (H200, driver 580). A software rasteriser's do not, and there explicit ones cost more.
const bool kOwnGradients = (MATERIAL_FLAGS & kMaterialGradients) != 0;
#define sampleMaterial(slot, v)                                                                    \
    (kOwnGradients                                                                                 \
         ? textureGrad(slot##_texture, slotUv(v, material.uv[slot##_slot]),                        \
                       uvDx(v, material.uv[slot##_slot]), uvDy(v, material.uv[slot##_slot]))       \
         : texture(slot##_texture, slotUv(v, material.uv[slot##_slot])))
#define uvDx(v, t) dFdx(slotUv(v, t))
#define uvDy(v, t) dFdy(slotUv(v, t))
#define positionDx(position) dFdx(position)
#define positionDy(position) dFdy(position)
