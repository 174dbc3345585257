// A JPEG, first pass: pixels become blocks of coefficients and these become Huffman codes, unit by
// unit in the scan's order; a workgroup's run of units has its codes to itself.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "interface/jpeg_io.h"
layout(local_size_x = kJpegGroup) in;
#include "lib/jpeg.glsl"
#include "lib/jpeg_dct.glsl"
#include "lib/ycc_samples.glsl"

// A row takes nine words, so that neither rows nor columns of several blocks meet in a bank.
const uint kRow = 9u;
const uint kBlock = kJpegLanes * kRow;
// Samples, then coefficients in the scan's order. Last, three blocks of the unit before the run,
// whose samples add up to the DC before the run's first: luma, blue, red.
shared int values[(kJpegGroupBlocks + 3u) * kBlock];
shared uint coded[2 * kJpegGroupBlocks]; // a bit a coefficient that is not 0, but for DC
shared int before[3];                    // sums of the unit before
shared uint code_words[kJpegGroupWords + 1u];
shared uint full_bytes[kJpegAlignments];

uint placeIn(uint block, uint k) { return block * kBlock + (k >> 3) * kRow + (k & 7u); }

// A block of the workgroup.
struct Block {
    uvec2 unit;
    uint component; // luma, blue, red
    uvec2 at;       // luma's, in blocks of the picture
    bool real;      // else it stands for what lies beyond the picture
};

uvec2 lumaBlocks() { return (uvec2(picture.width_px, picture.height_px) + 7u) / 8u; }

Block blockOf(uint index) {
    uint unit = gl_WorkGroupID.x * kGroupUnits + index / kUnitBlocks;
    uint i = index % kUnitBlocks;
    uint luma = kSampling * kSampling;
    Block block;
    block.unit = uvec2(unit % picture.units_across, unit / picture.units_across);
    block.component = i < luma ? 0u : i - luma + 1u;
    block.at = kSampling * block.unit + uvec2(i % kSampling, i / kSampling);
    block.real = unit < picture.unit_count &&
                 (block.component > 0u || all(lessThan(block.at, lumaBlocks())));
    return block;
}

// Luma's last block of a unit that is real, from the unit's first on: others have its DC.
uvec2 lastLuma(uvec2 unit) {
    return min(uvec2(kSampling - 1u), lumaBlocks() - 1u - kSampling * unit);
}

// A chroma sample of the run's units, or of the unit before (`unit` 0), and luma's of its pixels.
void loadSample(uint unit, uint k) {
    uint at = gl_WorkGroupID.x * kGroupUnits + unit;
    if (at == 0u || at > picture.unit_count) {
        return;
    }
    uvec2 unit_at = uvec2((at - 1u) % picture.units_across, (at - 1u) / picture.units_across);
    uvec2 within = uvec2(k & 7u, k >> 3);
    uvec2 sample_at = 8u * unit_at + within;
    ChromaPixels pixels = chromaPixelsAt(sample_at.x, sample_at.y);
    ivec2 chroma = chromaOf(pixels, sample_at.x);
    uint first = unit > 0u ? (unit - 1u) * kUnitBlocks : kJpegGroupBlocks;
    uint chroma_block = first + (unit > 0u ? kSampling * kSampling : 1u);
    values[placeIn(chroma_block, k)] = chroma.x;
    values[placeIn(chroma_block + 1u, k)] = chroma.y;
    uvec2 last = lastLuma(unit_at);
    [[unroll]] for (uint i = 0u; i < kSampling * kSampling; ++i) {
        uvec2 pixel = kSampling * within + uvec2(i % kSampling, i / kSampling);
        uvec2 block = pixel / 8u;
        if (unit == 0u && block != last) {
            continue;
        }
        uint row = min(8u * kSampling * unit_at.y + pixel.y, picture.height_px - 1u);
        ivec3 rgb = row == kSampling * pixels.row
                        ? pixels.rgb[i % kSampling]
                        : pixels.rgb[(kSampling - 1u) * kSampling + i % kSampling];
        uint luma_block = first + (unit > 0u ? block.y * kSampling + block.x : 0u);
        values[placeIn(luma_block, (pixel.y & 7u) * 8u + (pixel.x & 7u))] = lumaOf(rgb);
    }
}

void loadSamples() {
    const uint kSamples = (kGroupUnits + 1u) * kJpegBlockSize;
    for (uint i = gl_LocalInvocationIndex; i < kSamples; i += kJpegGroup) {
        loadSample(i / kJpegBlockSize, i % kJpegBlockSize);
    }
}

// A coefficient, divided and rounded.
int quantised(int value, JpegDivisor divisor) {
    uint size = (uint(abs(value)) + divisor.correction) * divisor.reciprocal >> divisor.shift;
    return value < 0 ? -int(size) : int(size);
}

// Codes hold differences of DC to the block before, so the run's first need those of the unit
// before it. A block's DC is the sum of its samples, divided.
void addUpBefore() {
    uint self = gl_LocalInvocationIndex;
    if (self < 3u * kJpegLanes) {
        uint component = self / kJpegLanes;
        int sum = 0;
        [[unroll]] for (uint i = 0u; i < 8u; ++i) {
            sum += values[placeIn(kJpegGroupBlocks + component, 8u * (self % kJpegLanes) + i)];
        }
        atomicAdd(before[component], sum);
    }
}

int dcBefore(uint component) {
    return gl_WorkGroupID.x > 0u
               ? quantised(before[component], tables[min(component, 1u)].divisors[0])
               : 0;
}

// Rows, then columns. The lane's eight coefficients of what is coded are returned, in the scan's
// order.
int[8] transformBlocks(uint index, uint lane, uint table) {
    int v[8];
    [[unroll]] for (uint i = 0u; i < 8u; ++i) { v[i] = values[index * kBlock + lane * kRow + i]; }
    transform(v, false);
    [[unroll]] for (uint i = 0u; i < 8u; ++i) { values[index * kBlock + lane * kRow + i] = v[i]; }
    barrier();
    [[unroll]] for (uint i = 0u; i < 8u; ++i) { v[i] = values[index * kBlock + i * kRow + lane]; }
    transform(v, true);
    barrier();
    [[unroll]] for (uint i = 0u; i < 8u; ++i) {
        JpegDivisor divisor = tables[table].divisors[8u * i + lane];
        values[placeIn(index, divisor.place)] = quantised(v[i], divisor);
    }
    barrier();
    uint mask = 0u;
    [[unroll]] for (uint i = 0u; i < 8u; ++i) {
        v[i] = values[index * kBlock + lane * kRow + i];
        mask |= v[i] != 0 ? 1u << i : 0u;
    }
    mask &= lane == 0u ? ~1u : ~0u;
    atomicOr(coded[2u * index + lane / 4u], mask << (8u * (lane & 3u)));
    return v;
}

int dcOf(uint index) { return values[index * kBlock]; }

// What a block's DC differs from the one coded before it by. Those beyond the picture have the DC
// of whatever came before them.
int dcDifference(uint index, Block block) {
    uint i = index % kUnitBlocks;
    uint unit = index - i; // its first block
    uint luma = kSampling * kSampling;
    int last;
    if (block.component == 0u && i > 0u) {
        bool right_is_real = block.at.x + 1u < lumaBlocks().x || (i & 1u) == 1u;
        last = dcOf(i == 2u && !right_is_real ? unit : index - 1u);
    } else if (unit > 0u) { // of the unit before
        uint before_it = unit - kUnitBlocks;
        if (block.component > 0u) {
            last = dcOf(before_it + i);
        } else {
            uvec2 real = lastLuma(blockOf(before_it).unit);
            last = dcOf(before_it + real.y * kSampling + real.x);
        }
    } else {
        last = dcBefore(block.component);
    }
    return dcOf(index) - last;
}

// A code with the bits of a value behind it, and how many bits they are together.
struct Code {
    uint bits;
    uint bit_count;
};

Code symbol(uint huffman) { return Code(huffman & 0xffffu, huffman >> 16); }

// The bits of negative values are those of one less (T.81, F.1.2.1).
Code withValue(uint huffman, int value, uint size) {
    uint bits = uint(value < 0 ? value - 1 : value) & ((1u << size) - 1u);
    return Code((huffman & 0xffffu) << size | bits, (huffman >> 16) + size);
}

uint sizeOf(int value) { return uint(findMSB(uint(abs(value))) + 1); }

// The last coefficient before this one that is not 0; DC, where there is none.
uint lastCoded(uint index, uint k) {
    uint low = coded[2u * index];
    uint high = coded[2u * index + 1u];
    int last = k < 32u ? findMSB(low & ((1u << k) - 1u)) : findMSB(high & ((1u << (k - 32u)) - 1u));
    last = k < 32u ? last : last >= 0 ? last + 32 : findMSB(low);
    return uint(max(last, 0));
}

// A lane's part of its block's code: the first one's begins with DC, the last one's ends the block
// where its last coefficients are 0.
struct LaneCodes {
    Code first;
    Code ac[8];
    uint skips[8]; // codes of 16 zeros each, before it
    Code last;
};

const Code kNone = Code(0u, 0u);
const uint kSixteenZeros = 0xf0u;

LaneCodes codesOf(uint index, uint lane, Block block, uint table, int values_of_lane[8]) {
    LaneCodes codes_of_lane;
    codes_of_lane.first = kNone;
    if (lane == 0u) {
        int difference = block.real ? dcDifference(index, block) : 0;
        uint size = sizeOf(difference);
        codes_of_lane.first = withValue(tables[table].dc_codes[size], difference, size);
    }
    uint last = lastCoded(index, 8u * lane);
    [[unroll]] for (uint i = 0u; i < 8u; ++i) { // T.81, F.1.2.2
        uint k = 8u * lane + i;
        int value = values_of_lane[i];
        bool is_coded = block.real && k > 0u && value != 0;
        codes_of_lane.ac[i] = kNone;
        codes_of_lane.skips[i] = 0u;
        if (is_coded) {
            uint zeros = k - last - 1u;
            uint size = sizeOf(value);
            codes_of_lane.ac[i] =
                withValue(tables[table].ac_codes[(zeros & 15u) << 4 | size], value, size);
            codes_of_lane.skips[i] = zeros / 16u;
            last = k;
        }
    }
    bool ends = lane == 7u && (!block.real || coded[2u * index + 1u] >> 31 == 0u);
    codes_of_lane.last = ends ? symbol(tables[table].ac_codes[0]) : kNone;
    return codes_of_lane;
}

uint lengthOf(LaneCodes its, Code skip) {
    uint sum = its.first.bit_count + its.last.bit_count;
    [[unroll]] for (uint i = 0u; i < 8u; ++i) {
        sum += its.ac[i].bit_count + its.skips[i] * skip.bit_count;
    }
    return sum;
}

// On the way to code_words: whole words as they fill.
struct Writer {
    uint word;
    uint used; // bits of it
    uint bits; // from the highest
};

void put(inout Writer writer, Code code) {
    uint left = 32u - writer.used;
    if (code.bit_count < left) {
        writer.bits |= code.bits << (left - code.bit_count);
        writer.used += code.bit_count;
    } else {
        uint over = code.bit_count - left;
        atomicOr(code_words[writer.word], writer.bits | code.bits >> over);
        ++writer.word;
        writer.used = over;
        writer.bits = over > 0u ? code.bits << (32u - over) : 0u;
    }
}

// From this bit of the run on.
void write(LaneCodes its, Code skip, uint bit) {
    Writer writer = Writer(bit >> 5, bit & 31u, 0u);
    if (its.first.bit_count > 0u) {
        put(writer, its.first);
    }
    [[unroll]] for (uint i = 0u; i < 8u; ++i) {
        if (its.ac[i].bit_count > 0u) {
            for (uint k = 0u; k < its.skips[i]; ++k) {
                put(writer, skip);
            }
            put(writer, its.ac[i]);
        }
    }
    if (its.last.bit_count > 0u) {
        put(writer, its.last);
    }
    if (writer.used > 0u) {
        atomicOr(code_words[writer.word], writer.bits);
    }
}

// Bits at which eight 1s begin, the first highest; `next`: the word behind.
uint beginsOfOnes(uint word, uint next) {
    uint ones = word & (word << 1 | next >> 31);
    uint next_ones = next & next << 1;
    ones &= ones << 2 | next_ones >> 30;
    next_ones &= next_ones << 2;
    return ones & (ones << 4 | next_ones >> 28);
}

// The run's codes, and its bytes FF for each bit at which a byte may begin.
void storeRun(uint bits) {
    uint run = gl_WorkGroupID.x;
    for (uint i = gl_LocalInvocationIndex; i < (bits + 31u) / 32u; i += kJpegGroup) {
        codes[run * kJpegGroupWords + i] = code_words[i];
        uint ones = beginsOfOnes(code_words[i], code_words[i + 1u]);
        for (uint k = 0u; ones != 0u && k < kJpegAlignments; ++k) {
            atomicAdd(full_bytes[k], uint(bitCount(ones & 0x80808080u >> k)));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex < kJpegAlignments) {
        runs[run].full_bytes[gl_LocalInvocationIndex] = full_bytes[gl_LocalInvocationIndex];
    }
    if (gl_LocalInvocationIndex == 0u) {
        uint last = bits - 7u;
        uint shift = last & 31u;
        uint end = code_words[last >> 5] << shift;
        end |= shift > 0u ? code_words[(last >> 5) + 1u] >> (32u - shift) : 0u;
        runs[run].bits = bits;
        runs[run].leading_ones = uint(min(31 - findMSB(~code_words[0]), 7));
        runs[run].trailing_ones = uint(findLSB(~(end >> 25)));
    }
}

void main() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = self; i <= kJpegGroupWords; i += kJpegGroup) {
        code_words[i] = 0u;
    }
    if (self < 2u * kJpegGroupBlocks) {
        coded[self] = 0u;
    }
    if (self < 3u) {
        before[self] = 0;
    }
    if (self < kJpegAlignments) {
        full_bytes[self] = 0u;
    }
    loadSamples();
    barrier();
    uint index = self / kJpegLanes;
    uint lane = self % kJpegLanes;
    Block block = blockOf(index);
    uint table = min(block.component, 1u);
    addUpBefore();
    int values_of_lane[8] = transformBlocks(index, lane, table);
    barrier();

    bool exists = block.unit.y * picture.units_across + block.unit.x < picture.unit_count;
    LaneCodes its = codesOf(index, lane, block, table, values_of_lane);
    Code skip = symbol(tables[table].ac_codes[kSixteenZeros]);
    uint bits;
    uint bit = scanGroup(exists ? lengthOf(its, skip) : 0u, bits);
    if (exists) {
        write(its, skip, bit);
    }
    barrier();
    storeRun(bits);
}
