#include "render/frame/jpeg_file.h"

#include "core/ceil_divide.h"

#include <algorithm>
#include <cstring>

namespace froxel::render {

JpegSizes::JpegSizes(const settings::Size& size, const JpegFormat& format) {
    const uint32_t unit_px = 8 * format.luma_sampling;
    const uint32_t unit_blocks = format.luma_sampling * format.luma_sampling + 2;
    picture.width_px = size.width_px;
    picture.height_px = size.height_px;
    picture.units_across = ceilDivide(size.width_px, unit_px);
    picture.unit_count = picture.units_across * ceilDivide(size.height_px, unit_px);
    picture.run_count = ceilDivide(picture.unit_count, io::kJpegGroupBlocks / unit_blocks);
    run_bytes = picture.run_count * sizeof(io::JpegRun);
    place_bytes = (uint64_t{picture.run_count} + 1) * sizeof(io::JpegPlace);
    code_bytes = (uint64_t{picture.run_count} * io::kJpegGroupWords + 1) * sizeof(uint32_t);
    // As much as TurboJPEG has room for: tjBufSize().
    const uint32_t samples = unit_blocks * static_cast<uint32_t>(kJpegBlock);
    const uint32_t most = 2 * picture.unit_count * samples + 2048;
    const auto header_bytes = static_cast<uint32_t>(format.header.size());
    picture.scan_at = ceilDivide(4 + header_bytes, 4U) * 4;
    picture.scan_bytes = most - header_bytes;
    header_at = picture.scan_at - header_bytes;
    file_bytes = ceilDivide(picture.scan_at + picture.scan_bytes, 4U) * 4;
}

void writeJpegHeader(const JpegFormat& format, const JpegSizes& sizes, std::byte* mapped) {
    std::byte* header = mapped + sizes.header_at;
    std::ranges::copy(format.header, header);
    const auto put = [&](size_t at, uint32_t side_px) {
        header[at] = static_cast<std::byte>(side_px >> 8U);
        header[at + 1] = static_cast<std::byte>(side_px);
    };
    put(format.size_at, sizes.picture.height_px);
    put(format.size_at + 2, sizes.picture.width_px);
}

std::span<const std::byte> jpegFile(const JpegSizes& sizes, const std::byte* mapped) {
    uint32_t scan_bytes = 0;
    std::memcpy(&scan_bytes, mapped, sizeof(scan_bytes));
    if (scan_bytes == 0) {
        return {};
    }
    return {mapped + sizes.header_at, sizes.picture.scan_at - sizes.header_at + scan_bytes};
}

} // namespace froxel::render
