// What the visibility passes share: the pixel's id, and which dispatch takes the pixel.
layout(set = 2, binding = 13) uniform utexture2D id_image;

// kAnyMaterial, or the one whose textures are bound.
layout(push_constant) uniform ResolveBlock {
    uint only_material;
    uint last; // 1: the last dispatch of the frame, which also fills empty pixels
};

// Whether this dispatch shades a pixel that shows `id`.
bool mine(uint id) {
    return only_material == kAnyMaterial ||
           items[meshlets[id >> kTriangleBits].item].material_index == only_material;
}
