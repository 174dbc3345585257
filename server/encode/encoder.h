// What the stream knows of an encoder, whatever its codec.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "core/pixel_view.h"
#include "settings/settings.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace froxel::encode {

struct EncodedPart {
    std::vector<std::byte> bytes;
    bool key = true; // decodes without any frame before it
};

// One thread at a time. Of a codec whose frames depend on earlier ones, one a stream of pictures.
class Encoder {
  public:
    Encoder() = default;
    virtual ~Encoder() = default;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // `part` is one of cut()'s. `key` asks for a frame that decodes by itself; `drawn_at` is for
    // rates over time. A picture that is a file of this codec already is copied. Errors:
    // kInvalidArgument for an empty or inconsistent view or options outside their ranges; kIo with
    // the library's text otherwise, and for a file that the device had no room for.
    [[nodiscard]] virtual Result<EncodedPart> encode(const PixelView& part,
                                                     const settings::Encoding& encoding,
                                                     bool key,
                                                     TimePoint drawn_at) = 0;

    // The parts of a picture that as many threads may encode apart, about `wanted`; the whole where
    // the codec knows no parts.
    [[nodiscard]] virtual std::vector<PixelView>
    cut(const PixelView& pixels, const settings::Encoding& /*encoding*/, size_t /*wanted*/) const {
        return {pixels};
    }
    // The picture of several parts of one cut(), in order. Errors: kIo.
    [[nodiscard]] virtual Result<std::vector<std::byte>>
    join(std::span<const std::vector<std::byte>> parts, uint32_t height_px) const;

    // Whether threads of its own work for it, beside the one that calls.
    [[nodiscard]] virtual bool hasThreads() const { return false; }
};

// `thread_count`: threads that it may use within a picture. Throws StartupError where the library
// cannot be set up.
[[nodiscard]] std::unique_ptr<Encoder> makeEncoder(settings::Codec codec, size_t thread_count);

} // namespace froxel::encode
