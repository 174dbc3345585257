// TurboJPEG's planes of pixels, to compare others' with.
#pragma once

#include "core/pixel_view.h"
#include "settings/settings.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace froxel::test {

// Luma, blue's and red's difference; rows with this many bytes behind them that belong to nobody.
inline std::array<std::vector<unsigned char>, 3>
planesOf(const PixelView& pixels, settings::Chroma chroma, size_t padding_bytes, PlaneView& view) {
    const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitCompress(), tjDestroy);
    const int sampling = chroma == settings::Chroma::k444 ? TJSAMP_444 : TJSAMP_420;
    const auto width = static_cast<int>(pixels.width_px);
    const auto height = static_cast<int>(pixels.height_px);
    std::array<std::vector<unsigned char>, 3> planes;
    std::array<unsigned char*, 3> starts{};
    std::array<int, 3> strides{};
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<size_t>(i);
        strides[at] = tjPlaneWidth(i, width, sampling) + static_cast<int>(padding_bytes);
        // TurboJPEG fills half rows that an odd size leaves.
        planes[at].resize(static_cast<size_t>(strides[at]) *
                          static_cast<size_t>(tjPlaneHeight(i, height, sampling)));
        starts[at] = planes[at].data();
        view.data[at] = reinterpret_cast<const std::byte*>(starts[at]);
        view.stride_bytes[at] = static_cast<size_t>(strides[at]);
    }
    EXPECT_EQ(tjEncodeYUVPlanes(handle.get(), reinterpret_cast<const unsigned char*>(pixels.data),
                                width, static_cast<int>(pixels.stride_bytes), height, TJPF_RGBX,
                                starts.data(), strides.data(), sampling, 0),
              0);
    return planes;
}

} // namespace froxel::test
