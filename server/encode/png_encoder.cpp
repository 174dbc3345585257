#include "encode/png_encoder.h"

#include "png/writer.h"

#include <utility>

namespace froxel::encode {

namespace {

class PngEncoder final : public Encoder {
  public:
    [[nodiscard]] Result<EncodedPart> encode(const PixelView& part,
                                             const settings::Encoding& /*encoding*/,
                                             bool /*key*/,
                                             TimePoint /*drawn_at*/) override {
        auto bytes = png::write(part);
        if (!bytes) {
            return bytes.error();
        }
        return EncodedPart{std::move(*bytes)};
    }
};

} // namespace

std::unique_ptr<Encoder> makePngEncoder(size_t /*thread_count*/) {
    return std::make_unique<PngEncoder>();
}

} // namespace froxel::encode
