#include "encode/encoder.h"

#include "core/assert.h"
#include "encode/jpeg_encoder.h"
#include "encode/png_encoder.h"
#include "encode/radiance_encoder.h"
#include "encode/vp9_encoder.h"

#include <array>

namespace froxel::encode {
namespace {

struct Maker {
    settings::Codec codec;
    std::unique_ptr<Encoder> (*make)(size_t thread_count);
};

// Beside settings::kCodecRows, which must know no library.
constexpr std::array kMakers = {
    Maker{settings::Codec::kJpeg, makeJpegEncoder}, Maker{settings::Codec::kVp9, makeVp9Encoder},
    Maker{settings::Codec::kPng, makePngEncoder},   Maker{settings::Codec::kExr, makeExrEncoder},
    Maker{settings::Codec::kPfm, makePfmEncoder},
};

constexpr bool oneARow() {
    for (size_t index = 0; index < kMakers.size(); ++index) {
        if (kMakers[index].codec != settings::kCodecRows[index].codec) {
            return false;
        }
    }
    return kMakers.size() == settings::kCodecRows.size();
}
static_assert(oneARow());

} // namespace

Result<std::vector<std::byte>> Encoder::join(std::span<const std::vector<std::byte>> parts,
                                             uint32_t /*height_px*/) const {
    FROXEL_ASSERT(parts.size() == 1, "a codec without parts");
    return parts.front();
}

std::unique_ptr<Encoder> makeEncoder(settings::Codec codec, size_t thread_count) {
    return kMakers[static_cast<size_t>(codec)].make(thread_count);
}

} // namespace froxel::encode
