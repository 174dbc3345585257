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

int lumaOf(ivec3 c) { return ((19595 * c.r + 38470 * c.g + 7471 * c.b + kHalf) >> 16) - 128; }

int lumaAt(uint x, uint y) { return lumaOf(rgbAt(x, y)); }

// Blue's and red's difference.
ivec2 chromaOf(ivec3 c) {
    return ivec2(-11059 * c.r - 21709 * c.g + 32768 * c.b + kChromaOffset,
                 32768 * c.r - 27439 * c.g - 5329 * c.b + kChromaOffset) >>
           16;
}

// The pixels of a chroma sample, row by row; the first of four at kSampling 1. Rows of chroma go on
// past the picture's last, whose pixels these are then.
struct ChromaPixels {
    ivec3 rgb[4];
    uint row; // of chroma, that they are of
};

ChromaPixels chromaPixelsAt(uint x, uint y) {
    ChromaPixels pixels;
    pixels.row = min(y, (picture.height_px - 1u) / kSampling);
    for (uint i = 0u; i < kSampling * kSampling; ++i) {
        pixels.rgb[i] =
            rgbAt(kSampling * x + i % kSampling, kSampling * pixels.row + i / kSampling);
    }
    return pixels;
}

// Of a mean's sum of four samples what is dropped is a half up in odd columns, down in even ones.
ivec2 chromaOf(ChromaPixels pixels, uint x) {
    if (kSampling == 1u) {
        return chromaOf(pixels.rgb[0]) - 128;
    }
    ivec2 sum = ivec2(1 + int(x & 1u));
    for (uint i = 0u; i < 4u; ++i) {
        sum += chromaOf(pixels.rgb[i]);
    }
    return (sum >> 2) - 128;
}
