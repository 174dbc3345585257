#include "encode/jpeg_stripes.h"

#include <algorithm>
#include <optional>

namespace froxel::encode {
namespace {

constexpr uint32_t kMinStripePixels = 100'000; // 0.4 ms of encoding

constexpr uint32_t kMaxInterval = 65'535; // coded units between restart markers

// Markers (T.81, table B.1).
constexpr uint8_t kSof0 = 0xC0;
constexpr uint8_t kRst0 = 0xD0;
constexpr uint8_t kSoi = 0xD8;
constexpr uint8_t kEoi = 0xD9;
constexpr uint8_t kSos = 0xDA;
constexpr uint8_t kDri = 0xDD;

uint32_t byteAt(std::span<const std::byte> jpeg, size_t at) {
    return std::to_integer<uint32_t>(jpeg[at]);
}

uint32_t wordAt(std::span<const std::byte> jpeg, size_t at) {
    return byteAt(jpeg, at) << 8U | byteAt(jpeg, at + 1);
}

void putWord(std::vector<std::byte>& out, uint32_t word) {
    out.push_back(static_cast<std::byte>(word >> 8U));
    out.push_back(static_cast<std::byte>(word));
}

// Where a JPEG's parts lie, in bytes from its start.
struct Layout {
    size_t height = 0; // the frame header's field
    size_t scan = 0;   // the scan header's marker
    size_t data = 0;   // first entropy-coded byte
    size_t end = 0;    // EOI
    uint32_t height_px = 0;
    uint32_t width_px = 0;
    uint32_t block_px = 8; // of a coded unit (MCU): 8 or 16 a side
};

std::optional<Layout> layoutOf(std::span<const std::byte> jpeg) {
    Layout out;
    if (jpeg.size() < 4 || wordAt(jpeg, 0) != (0xFF00U | kSoi) ||
        wordAt(jpeg, jpeg.size() - 2) != (0xFF00U | kEoi)) {
        return std::nullopt;
    }
    out.end = jpeg.size() - 2;
    for (size_t at = 2; at + 4 <= out.end && byteAt(jpeg, at) == 0xFF;) {
        const uint32_t marker = byteAt(jpeg, at + 1);
        const size_t next = at + 2 + wordAt(jpeg, at + 2);
        if (next > out.end) {
            return std::nullopt;
        }
        if (marker == kSof0 && next >= at + 12) {
            out.height = at + 5;
            out.height_px = wordAt(jpeg, at + 5);
            out.width_px = wordAt(jpeg, at + 7);
            out.block_px = 8 * (byteAt(jpeg, at + 11) >> 4U); // luma's sampling factor
        } else if (marker == kSos) {
            out.scan = at;
            out.data = next;
            return out.height != 0 && out.block_px != 0 ? std::optional(out) : std::nullopt;
        }
        at = next;
    }
    return std::nullopt;
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
        const auto& stripe = stripes[i];
        const auto layout = layoutOf(stripe);
        if (!layout) {
            return Error{ErrorCode::kIo, "TurboJPEG made a stripe that is not a baseline JPEG"};
        }
        const std::span<const std::byte> jpeg(stripe);
        if (i == 0) {
            append(out, jpeg.first(layout->scan));
            out[layout->height] = static_cast<std::byte>(height_px >> 8U);
            out[layout->height + 1] = static_cast<std::byte>(height_px);
            const uint32_t across = (layout->width_px + layout->block_px - 1) / layout->block_px;
            putWord(out, 0xFF00U | kDri);
            putWord(out, 4);
            putWord(out, across * (layout->height_px / layout->block_px));
            append(out, jpeg.subspan(layout->scan, layout->data - layout->scan));
        } else {
            putWord(out, 0xFF00U | (kRst0 + static_cast<uint32_t>((i - 1) % 8)));
        }
        append(out, jpeg.subspan(layout->data, layout->end - layout->data));
    }
    putWord(out, 0xFF00U | kEoi);
    return out;
}

} // namespace froxel::encode
