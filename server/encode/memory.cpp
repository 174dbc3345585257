#include "encode/memory.h"

namespace froxel::encode {

namespace {

// In the encoder, ready, in the newest-wins slot and being written, each as large as three bytes a
// pixel.
constexpr uint64_t kPictureBytes = 4 * 3;

} // namespace

uint64_t memoryBytes(const settings::Encoding& encoding, const settings::Size& size) {
    const uint64_t pixels = uint64_t{size.width_px} * size.height_px;
    const settings::EncoderMemory& kept = settings::rowOf(encoding.codec).memory;
    const bool full = encoding.chroma == settings::Chroma::k444;
    return kept.base_bytes + pixels * (kPictureBytes + (full ? kept.bytes_444 : kept.bytes_420));
}

} // namespace froxel::encode
