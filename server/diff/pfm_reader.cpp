#include "diff/pfm_reader.h"

#include "core/text.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace froxel::diff {
namespace {

Error broken(const std::string& reason) {
    return {ErrorCode::kIo, "is a broken PFM file: " + reason};
}

bool isSpace(char character) {
    return std::isspace(static_cast<unsigned char>(character)) != 0;
}

// The words of the header. One byte of white space ends the last; pixels follow.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    std::string_view next() {
        while (at_ < text_.size() && isSpace(text_[at_])) {
            ++at_;
        }
        const size_t begin = at_;
        while (at_ < text_.size() && !isSpace(text_[at_])) {
            ++at_;
        }
        return text_.substr(begin, at_ - begin);
    }
    // Where pixels begin, after the last word.
    [[nodiscard]] size_t end() const { return std::min(at_ + 1, text_.size()); }

  private:
    std::string_view text_;
    size_t at_ = 0;
};

template <class Number>
std::optional<Number> numberOf(std::string_view word) {
    Number number{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc() || end != word.data() + word.size()) {
        return std::nullopt;
    }
    return number;
}

struct Header {
    size_t channels = 3;
    PictureSize size;
    double scale = 1; // below 0: the least significant byte comes first
    size_t bytes = 0;
};

Result<Header> readHeader(std::string_view text) {
    Words words(text);
    Header header;
    header.channels = words.next() == "PF" ? 3 : 1;
    const auto width = numberOf<uint32_t>(words.next());
    const auto height = numberOf<uint32_t>(words.next());
    const auto scale = numberOf<double>(words.next());
    if (!width || !height || *width == 0 || *height == 0) {
        return broken("it has no width and height; expected whole numbers from 1");
    }
    if (!scale || !std::isfinite(*scale) || *scale == 0) {
        return broken("it has no scale; expected a number other than 0");
    }
    header.size = {*width, *height};
    header.scale = *scale;
    header.bytes = words.end();
    return header;
}

float valueAt(const std::byte* from, bool swap) {
    uint32_t bits = 0;
    std::memcpy(&bits, from, sizeof bits);
    if (swap) {
        bits = bits >> 24 | (bits >> 8 & 0xff00U) | (bits << 8 & 0xff0000U) | bits << 24;
    }
    return std::bit_cast<float>(bits);
}

} // namespace

bool isPfm(std::span<const std::byte> file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    return text.size() > 2 && (text.starts_with("PF") || text.starts_with("Pf")) &&
           isSpace(text[2]);
}

Result<LinearImage> readPfm(std::span<const std::byte> file,
                            const std::function<Result<void>(const PictureSize&)>& check) {
    static_assert(std::endian::native == std::endian::little, "negative scales are as here");
    constexpr size_t kMaxHeaderBytes = 256;
    const auto header = readHeader(
        {reinterpret_cast<const char*>(file.data()), std::min(file.size(), kMaxHeaderBytes)});
    if (!header) {
        return header.error();
    }
    const auto& [channels, size, scale, header_bytes] = *header;
    if (auto wanted = check(size); !wanted) {
        return wanted.error();
    }
    const uint64_t pixel_bytes = size.pixelCount() * channels * sizeof(float);
    if (file.size() - header_bytes < pixel_bytes) {
        return broken("it has " + numberText(file.size() - header_bytes) + " bytes of the " +
                      numberText(pixel_bytes) + " of " + numberText(size.width_px) + "x" +
                      numberText(size.height_px) + " pixels");
    }
    LinearImage image{size.width_px, size.height_px, std::vector<float>(size.pixelCount() * 3)};
    const std::byte* from = file.data() + header_bytes;
    const auto factor = static_cast<float>(std::abs(scale));
    for (size_t y = size.height_px; y-- > 0;) { // rows go bottom-up
        float* row = &image.rgb[y * size.width_px * 3];
        for (size_t i = 0; i < size_t{3} * size.width_px; ++i) {
            const size_t value = channels == 3 ? i : i / 3;
            row[i] = factor * valueAt(from + value * sizeof(float), scale > 0);
        }
        from += size.width_px * channels * sizeof(float);
    }
    return image;
}

} // namespace froxel::diff
