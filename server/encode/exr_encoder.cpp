#include "encode/exr_encoder.h"

#include "core/linear_image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

namespace froxel::encode {
namespace {

class Stream final : public Imf::OStream {
  public:
    Stream() : OStream("still") {}
    // The library goes back to fill in where the lines lie.
    void write(const char data[], int size) override {
        const auto count = static_cast<size_t>(size);
        bytes.resize(std::max(bytes.size(), at_ + count));
        std::memcpy(&bytes[at_], data, count);
        at_ += count;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }

    std::vector<std::byte> bytes;

  private:
    size_t at_ = 0;
};

// Throws what the library does.
std::vector<std::byte> write(const LinearImage& image) {
    constexpr std::array kChannels = {"R", "G", "B"};
    const auto width = static_cast<int>(image.width_px);
    const auto height = static_cast<int>(image.height_px);
    Imf::Header header(width, height);
    // ZIP spares 3 % of lit surfaces' floats, PIZ none, and both take 40 times as long.
    header.compression() = Imf::NO_COMPRESSION;
    Imf::FrameBuffer from;
    for (size_t channel = 0; channel < kChannels.size(); ++channel) {
        constexpr size_t kStride = kChannels.size() * sizeof(float);
        header.channels().insert(kChannels[channel], Imf::Channel(Imf::FLOAT));
        from.insert(kChannels[channel],
                    Imf::Slice::Make(Imf::FLOAT, &image.rgb[channel], header.dataWindow(), kStride,
                                     kStride * image.width_px));
    }
    Stream stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(from);
        file.writePixels(height);
    } // the last of it is written here
    return std::move(stream.bytes);
}

class ExrEncoder final : public Encoder {
  public:
    [[nodiscard]] Result<EncodedPart> encode(const PixelView& part,
                                             const settings::Encoding& /*encoding*/,
                                             bool /*key*/,
                                             TimePoint /*drawn_at*/) override {
        if (part.radiance == nullptr || part.width_px == 0 || part.height_px == 0) {
            return Error{ErrorCode::kInvalidArgument, "an empty picture, or one without radiance"};
        }
        try {
            return EncodedPart{write(radianceOf(part))};
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& failure) {
            return Error{ErrorCode::kIo, failure.what()};
        }
    }
};

} // namespace

std::unique_ptr<Encoder> makeExrEncoder(size_t /*thread_count*/) {
    return std::make_unique<ExrEncoder>();
}

} // namespace froxel::encode
