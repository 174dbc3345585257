// Samples of luma and chroma as libjpeg takes them from RGB (jccolor.c, jcsample.c), in 16-bit
// fixed point, 128 less. Past the picture's sides the last ones go on. Of pixels[], by
// picture.width_px and picture.height_px; kSampling: luma samples a chroma sample, each way.

const int kHalf = 1 << 15;
const int kChromaOffset = (128 << 16) + kHalf - 1;

ivec3 rgbAt(uint x, uint y) {
    uint pixel =
        pixels[min(y, picture.height_px - 1u) * picture.width_px + min(x, picture.width_px - 1u)];
    return ivec3(pixel & 255u, pixel >> 8 & 255u, pixel >> 16 & 255u);
}

int lumaAt(uint x, uint y) {
    ivec3 c = rgbAt(x, y);
    return ((19595 * c.r + 38470 * c.g + 7471 * c.b + kHalf) >> 16) - 128;
}

// Blue's and red's difference.
ivec2 chromaOf(ivec3 c) {
    return ivec2(-11059 * c.r - 21709 * c.g + 32768 * c.b + kChromaOffset,
                 32768 * c.r - 27439 * c.g - 5329 * c.b + kChromaOffset) >>
           16;
}

// Of a mean's sum of four samples what is dropped is a half up in odd columns, down in even ones.
ivec2 chromaAt(uint x, uint y) {
    if (kSampling == 1u) {
        return chromaOf(rgbAt(x, y)) - 128;
    }
    uint row = min(y, (picture.height_px - 1u) / 2u); // the picture's last goes on
    ivec2 sum = ivec2(1 + int(x & 1u));
    for (uint i = 0u; i < 4u; ++i) {
        sum += chromaOf(rgbAt(2u * x + (i & 1u), 2u * row + (i >> 1)));
    }
    return (sum >> 2) - 128;
}
