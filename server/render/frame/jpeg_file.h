// The file that the JPEG passes leave where the host reads it: its places in that buffer, and its
// header, which the host writes. Pure.
#pragma once

#include "core/jpeg_format.h"
#include "interface/jpeg_io.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace froxel::render {

// What a picture of one size takes, at most.
struct JpegSizes {
    JpegSizes() = default;
    JpegSizes(const settings::Size& size, const JpegFormat& format);

    io::JpegPicture picture{};
    uint64_t run_bytes = 0;
    uint64_t place_bytes = 0;
    uint64_t code_bytes = 0;
    [[nodiscard]] uint64_t scratchBytes() const { return run_bytes + place_bytes + code_bytes; }
    uint32_t header_at = 0;  // of the file, in the host's buffer
    uint64_t file_bytes = 0; // of that buffer
};

// For the host to read: a word, how many bytes of the file follow the header (0: they do not fit),
// then at JpegSizes::header_at the file. `mapped`: of at least file_bytes.
void writeJpegHeader(const JpegFormat& format, const JpegSizes& sizes, std::byte* mapped);
// The file; empty where it did not fit.
[[nodiscard]] std::span<const std::byte> jpegFile(const JpegSizes& sizes, const std::byte* mapped);

} // namespace froxel::render
