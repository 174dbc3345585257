#include "encode/jpeg_stripes.h"

#include "encode/jpeg_markers.h"

#include <algorithm>

namespace froxel::encode {
namespace {

constexpr uint32_t kMinStripePixels = 100'000; // 0.4 ms of encoding

constexpr uint32_t kMaxInterval = 65'535; // coded units between restart markers

void putWord(std::vector<std::byte>& out, uint32_t word) {
    out.push_back(static_cast<std::byte>(word >> 8U));
    out.push_back(static_cast<std::byte>(word));
}

void append(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

} // namespace

std::vector<PixelView> cutStripes(const PixelView& pixels, settings::Chroma chroma, size_t wanted) {
    const uint32_t block_px = chroma == settings::Chroma::k420 ? 16 : 8;
    const uint32_t width = std::max(1U, pixels.width_px);
    const auto parts = static_cast<uint32_t>(std::max<size_t>(wanted, 1));
    const uint32_t even = (pixels.height_px + parts - 1) / parts;
    const uint32_t least = std::max(even, (kMinStripePixels + width - 1) / width);
    uint32_t rows = (least + block_px - 1) / block_px * block_px;
    if (rows < pixels.height_px) {
        const uint32_t across = (width + block_px - 1) / block_px;
        rows = std::min(rows, kMaxInterval / across * block_px);
    }
    std::vector<PixelView> stripes;
    uint32_t top = 0;
    do {
        PixelView stripe = pixels;
        stripe.data += size_t{top} * pixels.stride_bytes;
        stripe.height_px = std::min(rows, pixels.height_px - top);
        stripes.push_back(stripe);
        top += rows;
    } while (top < pixels.height_px);
    return stripes;
}

Result<std::vector<std::byte>> joinStripes(std::span<const std::vector<std::byte>> stripes,
                                           uint32_t height_px) {
    std::vector<std::byte> out;
    size_t bytes = 16;
    for (const auto& stripe : stripes) {
        bytes += stripe.size();
    }
    out.reserve(bytes);
    for (size_t i = 0; i < stripes.size(); ++i) {
        const std::span<const std::byte> jpeg(stripes[i]);
        const auto parts = partsOf(jpeg);
        if (!parts) {
            return Error{ErrorCode::kIo, "TurboJPEG made a stripe that is not a baseline JPEG"};
        }
        if (i == 0) {
            const auto size = *sizeOf(*parts);
            const size_t scan = parts->find(marker::kSos)->at;
            append(out, jpeg.first(scan));
            out[size.at] = static_cast<std::byte>(height_px >> 8U);
            out[size.at + 1] = static_cast<std::byte>(height_px);
            const uint32_t unit_px = 8 * size.luma_sampling;
            putWord(out, 0xFF00U | marker::kDri);
            putWord(out, 4);
            putWord(out, (size.width_px + unit_px - 1) / unit_px * (size.height_px / unit_px));
            append(out, jpeg.subspan(scan, parts->data - scan));
        } else {
            putWord(out, 0xFF00U | (marker::kRst0 + static_cast<uint32_t>((i - 1) % 8)));
        }
        append(out, jpeg.subspan(parts->data, parts->end - parts->data));
    }
    putWord(out, 0xFF00U | marker::kEoi);
    return out;
}

} // namespace froxel::encode
