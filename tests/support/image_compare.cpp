#include "support/image_compare.h"

#include <png.h>

#include <cmath>
#include <cstdlib>

namespace froxel::test {

std::optional<RgbImage> readPng(const std::filesystem::path& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&header, path.c_str()) == 0) {
        return std::nullopt;
    }
    header.format = PNG_FORMAT_RGB;
    RgbImage image{header.width, header.height, {}};
    image.rgb8.resize(PNG_IMAGE_SIZE(header));
    if (png_image_finish_read(&header, nullptr, image.rgb8.data(), 0, nullptr) == 0) {
        return std::nullopt;
    }
    return image;
}

ImageDifference compare(const RgbImage& golden, const std::vector<std::byte>& rgba8) {
    const size_t pixel_count = size_t{golden.width_px} * golden.height_px;
    double squares = 0;
    double squares_up_to_8 = 0;
    size_t above = 0;
    for (size_t i = 0; i < pixel_count; ++i) {
        int worst = 0;
        int of_pixel = 0;
        for (size_t c = 0; c < 3; ++c) {
            const int d = std::abs(std::to_integer<int>(golden.rgb8[i * 3 + c]) -
                                   std::to_integer<int>(rgba8[i * 4 + c]));
            of_pixel += d * d;
            worst = std::max(worst, d);
        }
        above += worst > 8 ? 1U : 0U;
        squares += of_pixel;
        squares_up_to_8 += worst > 8 ? 0 : of_pixel;
    }
    const auto count = static_cast<double>(pixel_count);
    return {std::sqrt(squares / (3 * count)), std::sqrt(squares_up_to_8 / (3 * count)),
            static_cast<double>(above) / count};
}

} // namespace froxel::test
