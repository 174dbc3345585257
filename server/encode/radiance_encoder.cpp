#include "encode/radiance_encoder.h"

#include "core/text.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <algorithm>
#include <array>
#include <bit>
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
    if (!image.depth_m.empty()) {
        header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
        from.insert("Z", Imf::Slice::Make(Imf::FLOAT, image.depth_m.data(), header.dataWindow()));
    }
    Stream stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(from);
        file.writePixels(height);
    } // the last of it is written here
    return std::move(stream.bytes);
}

[[nodiscard]] Result<void> check(const LinearImage& image) {
    const size_t values = size_t{image.width_px} * image.height_px * 3;
    const bool depth = image.depth_m.empty() || 3 * image.depth_m.size() == values;
    if (values == 0 || image.rgb.size() != values || !depth) {
        return Error{ErrorCode::kInvalidArgument, numberText(image.rgb.size()) +
                                                      " values do not make " +
                                                      numberText(image.width_px) + "x" +
                                                      numberText(image.height_px) + " pixels"};
    }
    return {};
}

using Writer = Result<std::vector<std::byte>> (*)(const LinearImage& image);

class RadianceEncoder final : public Encoder {
  public:
    explicit RadianceEncoder(Writer writer) : writer_(writer) {}

    [[nodiscard]] Result<EncodedPart> encode(const PixelView& part,
                                             const settings::Encoding& /*encoding*/,
                                             bool /*key*/,
                                             TimePoint /*drawn_at*/) override {
        if (part.output(Output::kRadiance) == nullptr || part.width_px == 0 ||
            part.height_px == 0) {
            return Error{ErrorCode::kInvalidArgument, "an empty picture, or one without radiance"};
        }
        auto bytes = writer_(radianceOf(part));
        if (!bytes) {
            return bytes.error();
        }
        return EncodedPart{std::move(*bytes)};
    }

  private:
    Writer writer_;
};

} // namespace

Result<std::vector<std::byte>> exrOf(const LinearImage& image) {
    if (auto checked = check(image); !checked) {
        return checked.error();
    }
    try {
        return write(image);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        return Error{ErrorCode::kIo, failure.what()};
    }
}

Result<std::vector<std::byte>> pfmOf(const LinearImage& image) {
    static_assert(std::endian::native == std::endian::little, "PFM is written as it lies here");
    if (auto checked = check(image); !checked) {
        return checked.error();
    }
    // The negative scale says little endian; rows go bottom-up.
    const std::string header =
        "PF\n" + numberText(image.width_px) + " " + numberText(image.height_px) + "\n-1.0\n";
    const size_t row_bytes = size_t{image.width_px} * 3 * sizeof(float);
    std::vector<std::byte> bytes(header.size() + row_bytes * image.height_px);
    std::memcpy(bytes.data(), header.data(), header.size());
    const auto* rows = reinterpret_cast<const std::byte*>(image.rgb.data());
    for (size_t y = 0; y < image.height_px; ++y) {
        std::memcpy(bytes.data() + header.size() + y * row_bytes,
                    rows + (image.height_px - 1 - y) * row_bytes, row_bytes);
    }
    return bytes;
}

std::unique_ptr<Encoder> makeExrEncoder(size_t /*thread_count*/) {
    return std::make_unique<RadianceEncoder>(exrOf);
}

std::unique_ptr<Encoder> makePfmEncoder(size_t /*thread_count*/) {
    return std::make_unique<RadianceEncoder>(pfmOf);
}

} // namespace froxel::encode
