// Which batch a pass of the raster in compute is for, and which material.
layout(push_constant) uniform RasterBlock {
    uint only_material; // of masked ones: kAnyMaterial, or that whose textures are bound
    uint batch;
};
