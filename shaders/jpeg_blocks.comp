// A JPEG, first pass: pixels become blocks of coefficients and these become Huffman codes, unit by
// unit in the scan's order; a workgroup's run of units has its codes to itself. The last workgroup
// finds out where in the scan each run begins.
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
shared int values[kJpegGroupBlocks * kBlock]; // samples, then coefficients in the scan's order
shared uint coded[2 * kJpegGroupBlocks];      // a bit a coefficient that is not 0, but for DC
shared int before[3];                         // DC of luma, blue and red in the unit before the run
shared uint code_words[kJpegGroupWords];

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

void loadSamples() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = self; i < kJpegGroupBlocks * kJpegBlockSize; i += kJpegGroup) {
        Block block = blockOf(i / kJpegBlockSize);
        uvec2 within = uvec2(i & 7u, i >> 3 & 7u);
        if (block.component == 0u) {
            uvec2 at = 8u * block.at + within;
            values[placeIn(i / kJpegBlockSize, i & 63u)] = lumaAt(at.x, at.y);
        } else if (block.component == 1u) {
            uvec2 at = 8u * block.unit + within;
            ivec2 chroma = chromaAt(at.x, at.y);
            values[placeIn(i / kJpegBlockSize, i & 63u)] = chroma.x;
            values[placeIn(i / kJpegBlockSize + 1u, i & 63u)] = chroma.y;
        }
    }
}

// A coefficient, divided and rounded.
int quantised(int value, JpegDivisor divisor) {
    uint size = (uint(abs(value)) + divisor.correction) * divisor.reciprocal >> divisor.shift;
    return value < 0 ? -int(size) : int(size);
}

// Codes hold differences of DC to the block before, so the run's first need those of the unit
// before it. A block's DC is the sum of its samples, divided.
void findBefore() {
    uint self = gl_LocalInvocationIndex;
    uint first = gl_WorkGroupID.x * kGroupUnits;
    if (first > 0u) {
        uint component = self / kJpegBlockSize;
        uvec2 unit =
            uvec2((first - 1u) % picture.units_across, (first - 1u) / picture.units_across);
        uvec2 within = uvec2(self & 7u, self >> 3 & 7u);
        // Luma's last that is real: others have its DC.
        uvec2 luma = min(kSampling * unit + (kSampling - 1u), lumaBlocks() - 1u);
        uvec2 at = 8u * (component == 0u ? luma : unit) + within;
        int value = component == 0u   ? lumaAt(at.x, at.y)
                    : component == 1u ? chromaAt(at.x, at.y).x
                                      : chromaAt(at.x, at.y).y;
        atomicAdd(before[component], value);
    }
    barrier();
    if (self < 3u) {
        before[self] = quantised(before[self], tables[min(self, 1u)].divisors[0]);
    }
}

// Rows, then columns; what is left in `values` is what is coded.
void transformBlocks(uint index, uint lane, uint table) {
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
        int value = quantised(v[i], divisor);
        values[placeIn(index, divisor.place)] = value;
        if (value != 0 && divisor.place > 0u) {
            atomicOr(coded[2u * index + (divisor.place >> 5)], 1u << (divisor.place & 31u));
        }
    }
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
            Block other = blockOf(before_it);
            uvec2 real = min(uvec2(kSampling - 1u), lumaBlocks() - 1u - other.at);
            last = dcOf(before_it + real.y * kSampling + real.x);
        }
    } else {
        last = before[block.component];
    }
    return dcOf(index) - last;
}

// Codes on their way to code_words, whole words as they fill; or measured alone.
struct Writer {
    bool measures;
    uint total; // of bits, so far
    uint word;
    uint used; // bits of it
    uint bits; // from the highest
};

void put(inout Writer writer, uint code, uint count) {
    writer.total += count;
    if (writer.measures) {
        return;
    }
    uint left = 32u - writer.used;
    if (count < left) {
        writer.bits |= code << (left - count);
        writer.used += count;
    } else {
        uint over = count - left;
        atomicOr(code_words[writer.word], writer.bits | code >> over);
        ++writer.word;
        writer.used = over;
        writer.bits = over > 0u ? code << (32u - over) : 0u;
    }
}

void putSymbol(inout Writer writer, uint huffman) { put(writer, huffman & 0xffffu, huffman >> 16); }

// A Huffman code with the bits of a value behind it, those of negative ones less 1 (T.81,
// F.1.2.1).
void putValue(inout Writer writer, uint huffman, int value, uint size) {
    uint bits = uint(value < 0 ? value - 1 : value) & ((1u << size) - 1u);
    put(writer, (huffman & 0xffffu) << size | bits, (huffman >> 16) + size);
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

// AC of a lane's eight coefficients (T.81, F.1.2.2).
void putCoefficients(inout Writer writer, uint index, uint lane, uint table) {
    uint first = 8u * lane;
    uint left = coded[2u * index + (first >> 5)] >> (first & 31u) & 255u;
    uint last = left != 0u ? lastCoded(index, first) : 0u;
    while (left != 0u) {
        uint i = uint(findLSB(left));
        left &= left - 1u;
        uint zeros = first + i - last - 1u;
        last = first + i;
        for (; zeros >= 16u; zeros -= 16u) {
            putSymbol(writer, tables[table].ac_codes[0xf0]);
        }
        int value = values[index * kBlock + lane * kRow + i];
        uint size = sizeOf(value);
        putValue(writer, tables[table].ac_codes[zeros << 4 | size], value, size);
    }
}

// A lane's part of its block's code: the first one's begins with DC, the last one's ends the block
// where its last coefficients are 0.
void putLane(inout Writer writer, uint index, uint lane, Block block, uint table) {
    if (lane == 0u) {
        int difference = block.real ? dcDifference(index, block) : 0;
        uint size = sizeOf(difference);
        putValue(writer, tables[table].dc_codes[size], difference, size);
    }
    if (block.real) {
        putCoefficients(writer, index, lane, table);
    }
    if (lane == 7u && (!block.real || coded[2u * index + 1u] >> 31 == 0u)) {
        putSymbol(writer, tables[table].ac_codes[0]);
    }
}

// Where the scan of so many bits is cut into chunks: its end lies within the last.
void planChunks(uint code_bits) {
    state.code_bits = code_bits;
    uint chunks = (code_bits + 7u) / 8u / kJpegChunkBytes + 1u;
    state.count = JpegDispatch(chunks, 1u, 1u);
}

void main() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = self; i < kJpegGroupWords; i += kJpegGroup) {
        code_words[i] = 0u;
    }
    if (self < 2u * kJpegGroupBlocks) {
        coded[self] = 0u;
    }
    if (self < 3u) {
        before[self] = 0;
    }
    loadSamples();
    barrier();
    uint index = self / kJpegLanes;
    uint lane = self % kJpegLanes;
    Block block = blockOf(index);
    uint table = min(block.component, 1u);
    transformBlocks(index, lane, table);
    findBefore();
    barrier();

    bool exists = block.unit.y * picture.units_across + block.unit.x < picture.unit_count;
    Writer writer = Writer(true, 0u, 0u, 0u, 0u);
    if (exists) {
        putLane(writer, index, lane, block, table);
    }
    uint total;
    uint at = scanGroup(writer.total, total);
    if (exists) {
        writer = Writer(false, 0u, at >> 5, at & 31u, 0u);
        putLane(writer, index, lane, block, table);
        if (writer.used > 0u) {
            atomicOr(code_words[writer.word], writer.bits);
        }
    }
    barrier();
    for (uint i = self; i < (total + 31u) / 32u; i += kJpegGroup) {
        codes[gl_WorkGroupID.x * kJpegGroupWords + i] = code_words[i];
    }
    if (self == 0u) {
        sums[gl_WorkGroupID.x] = total;
    }
    if (isLastGroup(0u)) {
        uint code_bits = addUp(0u, gl_NumWorkGroups.x);
        if (self == 0u) {
            planChunks(code_bits);
        }
    }
}
