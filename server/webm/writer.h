// VP9 frames of a constant rate to a WebM file (webmproject.org/docs/container), by libmatroska. A
// cluster holds what follows from a key frame, so that players seek to any of them. One thread at a
// time.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace froxel::webm {

struct Video {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    double frames_per_s = 0;
};

class Writer {
  public:
    // Replaces a file of that name. Errors: kIo, naming the file.
    [[nodiscard]] static Result<Writer> create(const std::filesystem::path& file,
                                               const Video& video);
    ~Writer();
    Writer(Writer&& other) noexcept;
    Writer& operator=(Writer&& other) noexcept;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    // The next frame; the first one must be a key frame (FROXEL_ASSERT). Errors: kIo.
    [[nodiscard]] Result<void> add(std::span<const std::byte> frame, bool key);
    // Writes the index of key frames and the duration; without it players read the file, but seek
    // slowly. Nothing may be added after it. Errors: kIo.
    [[nodiscard]] Result<void> finish();

  private:
    struct File;
    explicit Writer(std::unique_ptr<File> file);

    std::unique_ptr<File> file_;
};

} // namespace froxel::webm
