// The cosine transform of eight values in place, in libjpeg's integers: over rows, then over
// columns. libjpeg-turbo 2.1, jfdctfst.c and jfdctint.c; after Arai, Agui, Nakajima (1988), and
// Loeffler, Ligtenberg, Moschytz (1989).

// Of values as far from either end.
ivec4 pairSums(int v[8]) { return ivec4(v[0] + v[7], v[1] + v[6], v[2] + v[5], v[3] + v[4]); }
ivec4 pairDifferences(int v[8]) {
    return ivec4(v[0] - v[7], v[1] - v[6], v[2] - v[5], v[3] - v[4]);
}

// As its vector code multiplies: 16 bits of 4 a, times c in 14 bits.
int fastTimes(int a, int c) { return (bitfieldExtract(a << 2, 0, 16) * (c << 6)) >> 16; }

void fastTransform(inout int v[8]) {
    ivec4 s = pairSums(v);
    ivec4 d = pairDifferences(v);

    int e0 = s[0] + s[3];
    int e1 = s[1] + s[2];
    int e2 = s[1] - s[2];
    int e3 = s[0] - s[3];
    int z1 = fastTimes(e2 + e3, 181);
    v[0] = e0 + e1;
    v[4] = e0 - e1;
    v[2] = e3 + z1;
    v[6] = e3 - z1;

    int o0 = d[3] + d[2];
    int o1 = d[2] + d[1];
    int o2 = d[1] + d[0];
    int z5 = fastTimes(o0 - o2, 98);
    int z2 = fastTimes(o0, 139) + z5;
    int z4 = fastTimes(o2, 334) + z5;
    int z3 = fastTimes(o1, 181);
    int z11 = d[0] + z3;
    int z13 = d[0] - z3;
    v[5] = z13 + z2;
    v[3] = z13 - z2;
    v[1] = z11 + z4;
    v[7] = z11 - z4;
}

const int kPassBits = 2; // of the result of rows, that columns drop
const int kConstantBits = 13;

int rounded(int value, int bits) { return (value + (1 << (bits - 1))) >> bits; }

void accurateTransform(inout int v[8], bool columns) {
    ivec4 s = pairSums(v);
    ivec4 d = pairDifferences(v);
    int bits = columns ? kConstantBits + kPassBits : kConstantBits - kPassBits;

    int e0 = s[0] + s[3];
    int e1 = s[1] + s[2];
    int e2 = s[1] - s[2];
    int e3 = s[0] - s[3];
    v[0] = columns ? rounded(e0 + e1, kPassBits) : (e0 + e1) << kPassBits;
    v[4] = columns ? rounded(e0 - e1, kPassBits) : (e0 - e1) << kPassBits;
    int z = (e2 + e3) * 4433;
    v[2] = rounded(z + e3 * 6270, bits);
    v[6] = rounded(z - e2 * 15137, bits);

    int z1 = (d[3] + d[0]) * -7373;
    int z2 = (d[2] + d[1]) * -20995;
    int z3 = d[3] + d[1];
    int z4 = d[2] + d[0];
    int z5 = (z3 + z4) * 9633;
    z3 = z3 * -16069 + z5;
    z4 = z4 * -3196 + z5;
    v[7] = rounded(d[3] * 2446 + z1 + z3, bits);
    v[5] = rounded(d[2] * 16819 + z2 + z4, bits);
    v[3] = rounded(d[1] * 25172 + z2 + z3, bits);
    v[1] = rounded(d[0] * 12299 + z1 + z4, bits);
}

void transform(inout int v[8], bool columns) {
    if (kFast) {
        fastTransform(v);
    } else {
        accurateTransform(v, columns);
    }
}
