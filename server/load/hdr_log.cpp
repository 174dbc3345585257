#include "load/hdr_log.h"

#include "core/assert.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <openssl/evp.h>
#include <zlib.h>

namespace froxel::load {
namespace {

using Bytes = std::string;

constexpr int64_t kLeastUs = 1;
constexpr int64_t kMostUs = int64_t{3600} * 1'000'000;
constexpr uint32_t kDigits = 3;
// 2048 buckets of one unit hold three digits; each later group of 1024 has twice the width.
constexpr int kHalfMagnitude = 10;
constexpr uint64_t kMask = (uint64_t{2} << kHalfMagnitude) - 1;
// Of encoding V2, by which readers know the format; the low digit says that counts vary in length.
constexpr uint32_t kCookie = 0x1c849303 | 0x10;
constexpr uint32_t kCompressedCookie = 0x1c849304 | 0x10;

size_t indexOf(int64_t value_us) {
    const auto value = static_cast<uint64_t>(value_us);
    const int group = static_cast<int>(std::bit_width(value | kMask)) - (kHalfMagnitude + 1);
    const uint64_t within = value >> static_cast<unsigned>(group);
    const uint64_t base = (static_cast<uint64_t>(group) + 1) << kHalfMagnitude;
    return static_cast<size_t>(base + within - (uint64_t{1} << kHalfMagnitude));
}

template <class T>
void putBigEndian(Bytes& bytes, T value) {
    for (int shift = static_cast<int>(sizeof(T) - 1) * 8; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(static_cast<uint8_t>(value >> shift));
    }
}

// ZigZag, then 7 bits a byte, the least first.
void putVarying(Bytes& bytes, int64_t value) {
    auto rest = (static_cast<uint64_t>(value) << 1U) ^ static_cast<uint64_t>(value >> 63);
    while (rest >= 0x80) {
        bytes += static_cast<char>(static_cast<uint8_t>(rest | 0x80));
        rest >>= 7U;
    }
    bytes += static_cast<char>(static_cast<uint8_t>(rest));
}

// A count for each bucket up to the last; a run of empty ones is minus their number.
Bytes countsOf(const std::vector<int64_t>& counts) {
    Bytes bytes;
    for (size_t at = 0; at < counts.size();) {
        const auto next = std::find_if(counts.begin() + static_cast<ptrdiff_t>(at), counts.end(),
                                       [](int64_t count) { return count != 0; });
        const auto empty = static_cast<size_t>(next - counts.begin()) - at;
        putVarying(bytes, empty > 1 ? -static_cast<int64_t>(empty) : counts[at]);
        at += std::max<size_t>(empty, 1);
    }
    return bytes;
}

Bytes histogramOf(const std::vector<int64_t>& counts) {
    const Bytes payload = countsOf(counts);
    Bytes bytes;
    putBigEndian(bytes, kCookie);
    putBigEndian(bytes, static_cast<uint32_t>(payload.size()));
    putBigEndian(bytes, uint32_t{0}); // no shift of the buckets
    putBigEndian(bytes, kDigits);
    putBigEndian(bytes, static_cast<uint64_t>(kLeastUs));
    putBigEndian(bytes, static_cast<uint64_t>(kMostUs));
    putBigEndian(bytes, std::bit_cast<uint64_t>(1.0)); // no factor on the values
    return bytes + payload;
}

Bytes compressed(const Bytes& bytes) {
    Bytes packed(compressBound(bytes.size()), '\0');
    uLongf size = packed.size();
    const int status = compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    FROXEL_ASSERT(status == Z_OK, "compressBound() is enough");
    packed.resize(size);
    Bytes framed;
    putBigEndian(framed, kCompressedCookie);
    putBigEndian(framed, static_cast<uint32_t>(size));
    return framed + packed;
}

std::string base64(const Bytes& bytes) {
    std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0'); // OpenSSL ends it with a zero
    const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
    text.resize(static_cast<size_t>(size));
    return text;
}

} // namespace

std::string hdrLogHeader(double start_s) {
    return fmt::format("#[Histogram log format version 1.3]\n"
                       "#[StartTime: {0:.3f} (seconds since epoch)]\n"
                       "#[BaseTime: {0:.3f} (seconds since epoch)]\n"
                       "#[MaxValueDivisor: 1000.0]\n"
                       "\"StartTimestamp\",\"Interval_Length\",\"Interval_Max\","
                       "\"Interval_Compressed_Histogram\"\n",
                       start_s);
}

std::string hdrLogLine(std::string_view tag,
                       Seconds begin,
                       Seconds length,
                       const std::vector<double>& samples_ms) {
    if (samples_ms.empty()) {
        return {};
    }
    std::vector<int64_t> counts;
    int64_t most_us = 0;
    for (const double sample_ms : samples_ms) {
        const int64_t value_us =
            std::clamp<int64_t>(std::llround(sample_ms * 1000), kLeastUs, kMostUs);
        const size_t index = indexOf(value_us);
        counts.resize(std::max(counts.size(), index + 1));
        ++counts[index];
        most_us = std::max(most_us, value_us);
    }
    return fmt::format("Tag={},{:.3f},{:.3f},{:.3f},{}\n", tag, begin.count(), length.count(),
                       static_cast<double>(most_us) / 1000,
                       base64(compressed(histogramOf(counts))));
}

} // namespace froxel::load
