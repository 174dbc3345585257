// A JPEG, last pass: a run's bytes into the file, a 0 behind each FF, and the marker of the end. A
// byte belongs to the run in which it begins.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/jpeg_io.h"
layout(local_size_x = kJpegStuffGroup) in;
#include "lib/jpeg.glsl"

const uint kChunkBytes = 4u * kJpegStuffGroup; // of the scan, at a time
// Of the file, from the word on in which the chunk begins to that in which the next one does.
const uint kMostWords = (2u * kChunkBytes + 16u) / 4u;
shared uint words[kMostWords];

// 32 bits of a run from this one on; behind its end is anything.
uint codeBits(uint run, uint bit) {
    uint at = run * kJpegGroupWords + (bit >> 5);
    uint shift = bit & 31u;
    uint bits = codes[at] << shift;
    return shift > 0u ? bits | codes[at + 1u] >> (32u - shift) : bits;
}

// 32 bits of the scan, from one on that lies in `run` or behind it; 1s behind its end (T.81,
// F.1.2.3).
uint scanBits(uint run, uint bit) {
    uint word = 0u;
    uint filled = 0u;
    for (; filled < 32u && run < picture.run_count; ++run) {
        uint at = bit + filled - places[run].bit;
        uint bits = places[run + 1u].bit - places[run].bit;
        if (at < bits) {
            uint take = min(bits - at, 32u - filled);
            word |= (codeBits(run, at) & 0xffffffffu << (32u - take)) >> filled;
            filled += take;
        }
    }
    return filled < 32u ? word | 0xffffffffu >> filled : word;
}

uint byteOf(uint word, uint i) { return word >> (24u - 8u * i) & 255u; }

uint countFullBytes(uint word, uint count) {
    uint full = 0u;
    for (uint i = 0u; i < count; ++i) {
        full += byteOf(word, i) == 255u ? 1u : 0u;
    }
    return full;
}

void putByte(uint at, uint byte) {
    if (at < 4u * kMostWords) {
        atomicOr(words[at >> 2], byte << (8u * (at & 3u)));
    }
}

// Bytes of the scan, from `at` of `words` on; where they end is returned.
uint putBytes(uint word, uint count, uint at) {
    for (uint i = 0u; i < count; ++i) {
        uint byte = byteOf(word, i);
        putByte(at, byte);
        at += byte == 255u ? 2u : 1u;
    }
    return at;
}

// Bytes of the scan from `begin` to `end`, which begin in `run`, to this byte of the file's scan
// on; where they end there is returned. All must call.
uint storeChunk(uint run, uint begin, uint end, uint file_at) {
    uint self = gl_LocalInvocationIndex;
    for (uint i = self; i < kMostWords; i += kJpegStuffGroup) {
        words[i] = 0u;
    }
    uint own = begin + 4u * self;
    uint count = own < end ? min(end - own, 4u) : 0u;
    uint word = count > 0u ? scanBits(run, 8u * own) : 0u;
    uint chunk_stuffed;
    uint stuffed_before = scanGroup(countFullBytes(word, count), chunk_stuffed);
    uint shift = file_at & 3u;
    putBytes(word, count, shift + 4u * self + stuffed_before);
    uint words_end = shift + end - begin + chunk_stuffed;
    if (self == 0u) { // what shares the last word with them
        uint left = min(scanBytes() - end, 4u);
        uint at = putBytes(scanBits(run, 8u * end), left, words_end);
        if (left < 4u) {
            putByte(at, 0xffu);
            putByte(at + 1u, 0xd9u);
        }
    }
    barrier();
    // A word belongs to the chunk that it begins in.
    uint word_count = (words_end + (end == scanBytes() ? 2u : 0u) + 3u) / 4u;
    for (uint i = self + (shift > 0u ? 1u : 0u); i < word_count; i += kJpegStuffGroup) {
        file[(picture.scan_at + file_at - shift) / 4u + i] = words[i];
    }
    barrier();
    return file_at + end - begin + chunk_stuffed;
}

void main() {
    if (stuffedScanBytes() > picture.scan_bytes) {
        return; // no room
    }
    uint run = gl_WorkGroupID.x;
    uint begin = (places[run].bit + 7u) / 8u;
    uint last = (places[run + 1u].bit + 7u) / 8u;
    uint file_at = begin + places[run].stuffed;
    for (; begin < last; begin += kChunkBytes) {
        file_at = storeChunk(run, begin, min(begin + kChunkBytes, last), file_at);
    }
}
