#include "unit/gltf/image_files.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <algorithm>
#include <memory>

namespace froxel::gltf::test {

Bytes jpegFile(uint32_t side_px, uint8_t red, uint8_t green, uint8_t blue, bool grey) {
    std::vector<uint8_t> pixels;
    for (size_t i = 0; i < size_t{side_px} * side_px; ++i) {
        pixels.insert(pixels.end(), {red, green, blue});
    }
    const auto side = static_cast<int>(side_px);
    const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const int status = tjCompress2(encoder.get(), pixels.data(), side, 0, side, TJPF_RGB, &data,
                                   &size, grey ? TJSAMP_GRAY : TJSAMP_444, 95, 0);
    EXPECT_EQ(status, 0) << tjGetErrorStr2(encoder.get());
    const auto* first = reinterpret_cast<const std::byte*>(data);
    Bytes bytes(first, first + size);
    tjFree(data);
    return bytes;
}

Bytes webpFile(const std::vector<uint8_t>& rgba, uint32_t side_px) {
    const auto width = static_cast<int>(side_px);
    const auto height = static_cast<int>(rgba.size() / 4 / side_px);
    uint8_t* data = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &data);
    EXPECT_GT(size, 0U);
    const auto* first = reinterpret_cast<const std::byte*>(data);
    Bytes bytes(first, first + size);
    WebPFree(data);
    return bytes;
}

std::string base64(const Bytes& bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) {
            bits = bits << 8U | (k < count ? std::to_integer<uint32_t>(bytes[i + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += k <= count ? kDigits[bits >> (18U - 6U * k) & 63U] : '=';
        }
    }
    return text;
}

} // namespace froxel::gltf::test
