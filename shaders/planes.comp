// Packed pixels -> planes of luma and chroma, as encoders of video take them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/planes_io.h"
layout(local_size_x = kPlanesGroup) in;

layout(constant_id = 0) const uint kSampling = 2;

layout(set = 0, binding = 0, scalar) readonly buffer PixelBlock { uint pixels[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer PlaneBlock { uint planes[]; };
layout(push_constant, scalar) uniform PictureBlock { PlanesPicture picture; };

#include "lib/ycc_samples.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    uint luma_words = picture.luma_row * picture.height_px;
    uint chroma_words = picture.chroma_row * picture.chroma_height;
    if (i < luma_words) {
        uvec2 at = uvec2(4u * (i % picture.luma_row), i / picture.luma_row);
        uint word = 0u;
        for (uint k = 0u; k < 4u; ++k) {
            word |= uint(lumaAt(at.x + k, at.y) + 128) << (8u * k);
        }
        planes[i] = word;
    } else if (i < luma_words + chroma_words) {
        uint c = i - luma_words;
        uvec2 at = uvec2(4u * (c % picture.chroma_row), c / picture.chroma_row);
        uvec2 words = uvec2(0u);
        for (uint k = 0u; k < 4u; ++k) {
            ChromaPixels pixels = chromaPixelsAt(at.x + k, at.y);
            words |= uvec2(chromaOf(pixels, at.x + k) + 128) << (8u * k);
        }
        planes[i] = words.x;
        planes[i + chroma_words] = words.y;
    }
}
