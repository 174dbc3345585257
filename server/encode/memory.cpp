#include "encode/memory.h"

namespace froxel::encode {

namespace {

// In the encoder, ready, in the newest-wins slot and being written, each as large as three bytes a
// pixel.
constexpr uint64_t kPictureBytes = 4 * 3;
// libvpx: references, what it knows of every block, threads.
constexpr uint64_t kVideoBase = 16 << 20U;
constexpr uint64_t kVideoBytes420 = 100;
constexpr uint64_t kVideoBytes444 = 130;

} // namespace

uint64_t memoryBytes(const view::Encoding& encoding, const view::Size& size) {
    const uint64_t pixels = uint64_t{size.width_px} * size.height_px;
    uint64_t bytes = pixels * kPictureBytes;
    if (view::isVideo(encoding.codec)) {
        const bool full = encoding.chroma == view::Chroma::k444;
        bytes += kVideoBase + pixels * (full ? kVideoBytes444 : kVideoBytes420);
    }
    return bytes;
}

} // namespace froxel::encode
