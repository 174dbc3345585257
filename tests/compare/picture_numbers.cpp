// Numbers of two PNG pictures of one size, as JSON on stdout:
//   picture_numbers difference PICTURE REFERENCE   how far they are apart, and where
//   picture_numbers clipped PICTURE DEPTH_VIEW     shares of surfaces, and of these black or blown
//   out
#include "compare/clipped.h"
#include "core/error.h"
#include "diff/picture.h"
#include "image_metrics/picture_error.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace froxel::test {
namespace {

using Json = nlohmann::ordered_json;

// Throws StartupError, naming the file.
diff::ShownPicture read(const std::string& path) {
    auto file = diff::read(path).value();
    auto* shown = std::get_if<diff::ShownPicture>(&file.picture);
    if (shown == nullptr) {
        throw StartupError({ErrorCode::kUnsupported, path + " holds radiance; expected colours"});
    }
    return std::move(*shown);
}

// The share of pixels in which one of the pictures is not as in its first pixel, which is
// background.
double drawnShare(const PixelView& picture, const PixelView& reference) {
    const auto drawn = [](const PixelView& view, uint32_t x, uint32_t y) {
        return image_metrics::bytesAt(view, x, y) != image_metrics::bytesAt(view, 0, 0);
    };
    uint64_t count = 0;
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            count += drawn(picture, x, y) || drawn(reference, x, y) ? 1U : 0U;
        }
    }
    return static_cast<double>(count) / (static_cast<double>(picture.width_px) * picture.height_px);
}

Json difference(const PixelView& picture, const PixelView& reference) {
    const auto perceived = image_metrics::perceivedDifference(picture, reference);
    return {{"flip", perceived.flip},
            {"mssim", perceived.mssim},
            {"drawn", drawnShare(picture, reference)}};
}

Json clipped(const PixelView& picture, const PixelView& depth_view) {
    const Clipped counts = countClipped(picture, depth_view);
    const auto share = [](uint64_t part, uint64_t whole) {
        return whole == 0 ? Json(nullptr)
                          : Json(static_cast<double>(part) / static_cast<double>(whole));
    };
    return {
        {"surface", share(counts.surface_count, uint64_t{picture.width_px} * picture.height_px)},
        {"black", share(counts.black_count, counts.surface_count)},
        {"blown", share(counts.blown_count, counts.surface_count)}};
}

int run(const std::string_view what, const std::string& first, const std::string& second) {
    const auto a = read(first);
    const auto b = read(second);
    if (a.size != b.size) {
        std::fprintf(stderr, "%s has %ux%u pixels, %s %ux%u; expected one size\n", first.c_str(),
                     a.size.width_px, a.size.height_px, second.c_str(), b.size.width_px,
                     b.size.height_px);
        return 1;
    }
    const Json numbers =
        what == "clipped" ? clipped(a.view(), b.view()) : difference(a.view(), b.view());
    std::printf("%s\n", numbers.dump().c_str());
    return 0;
}

} // namespace
} // namespace froxel::test

int main(int argc, char** argv) try {
    const std::string_view what = argc == 4 ? argv[1] : "";
    if (what != "difference" && what != "clipped") {
        std::fputs("usage: picture_numbers difference|clipped PICTURE.png OTHER.png\n", stderr);
        return 2;
    }
    return froxel::test::run(what, argv[2], argv[3]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
