// How TurboJPEG codes a picture, read out of a file that it made: for an encoder elsewhere whose
// bytes are to be the same.
#pragma once

#include "core/error.h"
#include "core/jpeg_format.h"
#include "settings/settings.h"

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace froxel::encode {

// The transform that a quality is coded with: TurboJPEG's own choice. From 96 on the fast one would
// show.
[[nodiscard]] constexpr JpegTransform jpegTransform(uint32_t quality) {
    return quality < 96 ? JpegTransform::kFast : JpegTransform::kAccurate;
}

// Errors: kInvalidArgument for a quality outside 1..100, kIo with what the library says.
[[nodiscard]] Result<JpegFormat> jpegFormat(const settings::Encoding& encoding);

// Keeps each format once it was asked for. One thread.
class JpegFormats {
  public:
    // Errors: as jpegFormat().
    [[nodiscard]] Result<std::shared_ptr<const JpegFormat>> of(const settings::Encoding& encoding);

  private:
    std::map<std::pair<uint32_t, settings::Chroma>, std::shared_ptr<const JpegFormat>> made_;
};

} // namespace froxel::encode
