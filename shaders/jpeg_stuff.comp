// A JPEG, last pass: the scan's bytes into the file, a 0 behind each FF, and the marker of the end.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/jpeg_io.h"
layout(local_size_x = kJpegChunk) in;
#include "lib/jpeg.glsl"
#include "lib/jpeg_scan.glsl"

// Of the chunk, from the word on in which it begins.
const uint kMostWords = (2u * kJpegChunkBytes + 16u) / 4u;
shared uint words[kMostWords];

void putByte(uint at, uint byte) {
    if (at < 4u * kMostWords) {
        atomicOr(words[at >> 2], byte << (8u * (at & 3u)));
    }
}

// Four bytes of the scan, from `at` of the chunk's words on.
void putWord(uint index, uint at) {
    uint end = scanBytes();
    if (4u * index > end) {
        return;
    }
    uint word = scanWord(index);
    for (uint i = 0u; i < 4u; ++i) {
        if (4u * index + i < end) {
            uint byte = byteOf(word, i);
            putByte(at, byte);
            at += byte == 255u ? 2u : 1u;
        } else if (4u * index + i == end) {
            putByte(at, 0xffu);
            putByte(at + 1u, 0xd9u);
        }
    }
}

void main() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = self; i < kMostWords; i += kJpegChunk) {
        words[i] = 0u;
    }
    uint first = gl_WorkGroupID.x * kJpegChunk;
    uint chunk_stuffed;
    uint stuffed_before = scanGroup(countStuffed(first + self), chunk_stuffed);
    uint begin = 4u * first + sums[picture.chunk_sums + gl_WorkGroupID.x];
    uint shift = begin & 3u;
    putWord(first + self, shift + 4u * self + stuffed_before);
    uint end = kJpegChunkBytes + chunk_stuffed + shift; // where the next chunk begins
    if (self == 0u) {
        putWord(first + kJpegChunk, end); // what of it shares this one's last word
    }
    barrier();
    // A word belongs to the chunk that it begins in.
    uint word_count = gl_WorkGroupID.x == gl_NumWorkGroups.x - 1u
                          ? (shift + scanBytes() - 4u * first + chunk_stuffed + 2u + 3u) / 4u
                          : (end + 3u) / 4u;
    for (uint i = self + (shift > 0u ? 1u : 0u); i < word_count; i += kJpegChunk) {
        file[(picture.scan_at + begin - shift) / 4u + i] = words[i];
    }
}
