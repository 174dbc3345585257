// Fast approximate antialiasing after Lottes (2009): where brightness changes, finds whether the
// edge runs along a row or a column, walks along it to both of its ends, and blends the pixel with
// the one across the edge by as much as a straight edge between those ends would cover of it.
// Single pixels that stick out are blended with what is around them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(set = 1, binding = 0) uniform utextureBuffer display_texels; // RGBA8 sRGB
layout(set = 1, binding = 1, scalar) writeonly buffer PixelBlock { uint pixels[]; };

const float kLeastContrast = 1.0 / 16.0; // of white
const float kLeastShare = 1.0 / 8.0;     // of the brightest around
const int kMostSteps = 12;               // along the edge, either way
const float kSinglePixels = 0.75;        // how much of a single pixel is blended away

ivec2 size() { return ivec2(frame.camera.width_px, frame.camera.height_px); }

uint packedAt(ivec2 at) {
    ivec2 inside = clamp(at, ivec2(0), size() - 1);
    return texelFetch(display_texels, inside.y * size().x + inside.x).x;
}

// Of the encoded colour, which is about as even as it looks.
float lumaOf(uint packed) { return dot(unpackUnorm4x8(packed).rgb, vec3(0.299, 0.587, 0.114)); }
float lumaAt(ivec2 at) { return lumaOf(packedAt(at)); }

// How far the edge goes on, and how much brighter than it the end is.
struct End {
    float steps;
    float above;
};

End walk(ivec2 at, ivec2 across, ivec2 along, float edge, float enough) {
    End end = End(float(kMostSteps), 0.0);
    // Past the picture's side nothing changes. No constant: a software device would unroll the
    // loop, compile it for longer and walk all of it for every pixel.
    int most = min(kMostSteps, max(size().x, size().y));
    for (int k = 1; k <= most; ++k) {
        ivec2 here = at + k * along;
        end.above = 0.5 * (lumaAt(here) + lumaAt(here + across)) - edge;
        if (abs(end.above) >= enough) {
            end.steps = float(k);
            break;
        }
    }
    return end;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, size()))) {
        return;
    }
    uint own = packedAt(at);
    uint result = own;
    float m = lumaOf(own);
    float n = lumaAt(at + ivec2(0, -1));
    float s = lumaAt(at + ivec2(0, 1));
    float w = lumaAt(at + ivec2(-1, 0));
    float e = lumaAt(at + ivec2(1, 0));
    float most = max(m, max(max(n, s), max(w, e)));
    float contrast = most - min(m, min(min(n, s), min(w, e)));
    if (contrast >= max(kLeastContrast, kLeastShare * most)) {
        float nw = lumaAt(at + ivec2(-1, -1));
        float ne = lumaAt(at + ivec2(1, -1));
        float sw = lumaAt(at + ivec2(-1, 1));
        float se = lumaAt(at + ivec2(1, 1));
        // Second differences across rows and across columns.
        float rows = 2.0 * abs(n + s - 2.0 * m) + abs(nw + sw - 2.0 * w) + abs(ne + se - 2.0 * e);
        float columns =
            2.0 * abs(w + e - 2.0 * m) + abs(nw + ne - 2.0 * n) + abs(sw + se - 2.0 * s);
        bool in_rows = rows >= columns;
        ivec2 along = in_rows ? ivec2(1, 0) : ivec2(0, 1);
        float before = in_rows ? n : w;
        float after = in_rows ? s : e;
        bool back = abs(before - m) >= abs(after - m);
        ivec2 across = (back ? -1 : 1) * along.yx;
        float other = back ? before : after;
        float edge = 0.5 * (m + other);
        float enough = 0.25 * abs(other - m);
        End first = walk(at, across, -along, edge, enough);
        End last = walk(at, across, along, edge, enough);
        End near = first.steps < last.steps ? first : last;
        // Of both pixels at the edge only the one on whose side it ends is covered by the other.
        bool covered = (near.above < 0.0) != (m < edge);
        float blend = covered ? 0.5 - near.steps / (first.steps + last.steps) : 0.0;
        float around = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
        float single = smoothstep(0.0, 1.0, min(abs(around - m) / contrast, 1.0));
        blend = max(blend, single * single * kSinglePixels);
        vec3 mixed = mix(srgbDecode(unpackUnorm4x8(own).rgb),
                         srgbDecode(unpackUnorm4x8(packedAt(at + across)).rgb), blend);
        result = packDisplay(mixed);
    }
    pixels[at.y * size().x + at.x] = result;
}
