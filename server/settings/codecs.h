// How pictures are encoded, for the stream and for stills: a row a codec, with all that others ask
// of it. They ask by a property of the row, never by a codec's name. Its encoder is in
// encode/encoder.cpp.
#pragma once

#include "core/host_form.h"
#include "core/outputs.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace froxel::settings {

enum class Codec : uint8_t { kJpeg, kVp9, kPng, kExr, kPfm };

// What a codec gives bits for, and what a slow link takes from it.
enum class RateControl : uint8_t {
    kNone,    // as many as a picture needs
    kQuality, // by Encoding::quality
    kBitrate, // by Encoding::video_kbps
};

// What an encoder keeps from picture to picture beside the pictures on their way.
struct EncoderMemory {
    uint64_t base_bytes = 0;
    uint64_t bytes_420 = 0; // a pixel, by chroma
    uint64_t bytes_444 = 0;
};

struct CodecRow {
    Codec codec = Codec::kJpeg;
    std::string_view name{};    // as in the schema, where it is streamed
    bool streamed = true;       // else of stills alone, which no client of the protocol gets
    bool chosen = true;         // by viewers; else by the server alone, for a picture that rests
    bool announced = false;     // only to clients whose Hello.codecs lists it; else all decode it
    bool frames_depend = false; // on those before them, back to a key frame: video
    bool lossless = false;      // and slow, so that it waits behind the others
    // In which its encoder takes pictures from a device that makes it; a file is copied.
    PictureForm device_form = PictureForm::kPixels;
    Outputs outputs{}; // that it makes files of, in place of pixels
    RateControl rate_control = RateControl::kNone;
    EncoderMemory memory{};
};

// In the order of Codec: those that viewers choose first, those of stills alone last.
inline constexpr std::array kCodecRows = {
    CodecRow{.codec = Codec::kJpeg,
             .name = "jpeg",
             .device_form = PictureForm::kFile,
             .rate_control = RateControl::kQuality},
    // Memory: measured with libvpx 1.12 from 640x360 to 4096x4096, references, what it knows of
    // every block, and threads: with the pictures 92 to 146 bytes a pixel, the most where pictures
    // are small.
    CodecRow{.codec = Codec::kVp9,
             .name = "vp9",
             .announced = true,
             .frames_depend = true,
             .device_form = PictureForm::kPlanes,
             .rate_control = RateControl::kBitrate,
             .memory = {.base_bytes = 16 << 20U, .bytes_420 = 100, .bytes_444 = 130}},
    CodecRow{.codec = Codec::kPng, .name = "png", .chosen = false, .lossless = true},
    // Memory: the means of the samples, planes for the library of OpenEXR, the file; floats.
    CodecRow{.codec = Codec::kExr,
             .name = "exr",
             .streamed = false,
             .chosen = false,
             .lossless = true,
             .outputs = {Output::kRadiance, Output::kDepth},
             .memory = {.base_bytes = 8 << 20U, .bytes_420 = 48, .bytes_444 = 48}},
    CodecRow{.codec = Codec::kPfm,
             .name = "pfm",
             .streamed = false,
             .chosen = false,
             .lossless = true,
             .outputs = {Output::kRadiance},
             .memory = {.base_bytes = 8 << 20U, .bytes_420 = 24, .bytes_444 = 24}},
};

[[nodiscard]] constexpr const CodecRow& rowOf(Codec codec) {
    return kCodecRows[static_cast<size_t>(codec)];
}

// What every session begins with, and goes back to where a viewer does not decode another.
inline constexpr Codec kPlainCodec = Codec::kJpeg;
inline constexpr Codec kLosslessCodec = Codec::kPng;
static_assert(rowOf(kPlainCodec).chosen && !rowOf(kPlainCodec).announced);
static_assert(rowOf(kLosslessCodec).lossless && !rowOf(kLosslessCodec).announced &&
              rowOf(kLosslessCodec).streamed);

namespace detail {

constexpr auto kChosenCount = static_cast<size_t>(std::count_if(
    kCodecRows.begin(), kCodecRows.end(), [](const auto& row) { return row.chosen; }));
constexpr auto kStreamedCount = static_cast<size_t>(std::count_if(
    kCodecRows.begin(), kCodecRows.end(), [](const auto& row) { return row.streamed; }));

template <size_t count>
constexpr std::array<std::string_view, count> firstNames() {
    std::array<std::string_view, count> names;
    for (size_t index = 0; index < count; ++index) {
        names[index] = kCodecRows[index].name;
    }
    return names;
}

constexpr bool inOrder() {
    for (size_t index = 0; index < kCodecRows.size(); ++index) {
        const CodecRow& row = kCodecRows[index];
        if (static_cast<size_t>(row.codec) != index || row.chosen != (index < kChosenCount) ||
            row.streamed != (index < kStreamedCount)) {
            return false;
        }
    }
    return true;
}
static_assert(inOrder());

} // namespace detail

// Of those in the schema, by the enumerator's number.
inline constexpr auto kCodecNames = detail::firstNames<detail::kStreamedCount>();
inline constexpr auto kAllCodecNames = detail::firstNames<kCodecRows.size()>();
inline constexpr auto kChosenCodecNames = detail::firstNames<detail::kChosenCount>();

// Which of them a client decodes, by the enumerator's number.
using CodecSet = std::bitset<kCodecRows.size()>;

[[nodiscard]] inline bool contains(const CodecSet& set, Codec codec) {
    return set.test(static_cast<size_t>(codec));
}

// Those that every client decodes.
[[nodiscard]] inline CodecSet commonCodecs() {
    CodecSet set;
    for (const CodecRow& row : kCodecRows) {
        set.set(static_cast<size_t>(row.codec), row.streamed && !row.announced);
    }
    return set;
}

} // namespace froxel::settings
