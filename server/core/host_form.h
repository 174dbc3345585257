// How a frame's picture comes to the host.
#pragma once

#include "core/jpeg_format.h"

#include <cstdint>
#include <memory>

namespace froxel {

enum class PictureForm : uint8_t {
    kPixels,
    kPlanes, // of luma and chroma
    kFile,   // encoded
};

// As packed pixels, unless one of these is said.
struct HostForm {
    std::shared_ptr<const JpegFormat> jpeg = {}; // a file of this kind
    uint32_t plane_sampling = 0; // planes: luma samples a chroma sample, across and down, 1 or 2

    bool operator==(const HostForm&) const = default;

    [[nodiscard]] PictureForm kind() const {
        return jpeg                 ? PictureForm::kFile
               : plane_sampling > 0 ? PictureForm::kPlanes
                                    : PictureForm::kPixels;
    }
};

} // namespace froxel
