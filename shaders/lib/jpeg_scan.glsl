// The scan's codes, run after run, as bytes.

// The workgroup of the first pass whose run holds this bit.
uint runAt(uint bit, uint run_count) {
    uint low = 0u;
    uint high = run_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (sums[middle] <= bit) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// 32 bits of a run from this one on; behind its end is anything.
uint codeBits(uint run, uint bit) {
    uint at = run * kJpegGroupWords + (bit >> 5);
    uint shift = bit & 31u;
    uint bits = codes[at] << shift;
    return shift > 0u ? bits | codes[at + 1u] >> (32u - shift) : bits;
}

uint scanBytes() { return (state.code_bits + 7u) / 8u; }

// 32 bits of the scan, the first highest; 1s behind its end (T.81, F.1.2.3).
uint scanWord(uint index) {
    uint run_count = picture.chunk_sums - 1u;
    uint begin = 32u * index;
    uint word = 0u;
    uint filled = 0u;
    if (begin < state.code_bits) {
        for (uint run = runAt(begin, run_count); filled < 32u && run < run_count; ++run) {
            uint at = begin + filled - sums[run];
            uint take = min(sums[run + 1u] - sums[run] - at, 32u - filled);
            uint bits = codeBits(run, at) & (0xffffffffu << (32u - take));
            word |= bits >> filled;
            filled += take;
        }
    }
    return filled < 32u ? word | 0xffffffffu >> filled : word;
}

uint byteOf(uint word, uint i) { return word >> (24u - 8u * i) & 255u; }

// How many of a word's bytes have a 0 stuffed behind them.
uint countStuffed(uint index) {
    uint end = scanBytes();
    uint count = 0u;
    if (4u * index < end) {
        uint word = scanWord(index);
        for (uint i = 0u; i < 4u; ++i) {
            count += 4u * index + i < end && byteOf(word, i) == 255u ? 1u : 0u;
        }
    }
    return count;
}
