// What a JPEG shows, by TurboJPEG.
#pragma once

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace froxel::encode {

struct Decoded {
    int width = 0;
    int height = 0;
    int subsampling = -1;
    std::vector<unsigned char> rgb;
};

inline Decoded decode(const std::vector<std::byte>& jpeg) {
    const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
    const auto* data = reinterpret_cast<const unsigned char*>(jpeg.data());
    Decoded out;
    int colorspace = 0;
    EXPECT_EQ(tjDecompressHeader3(handle.get(), data, jpeg.size(), &out.width, &out.height,
                                  &out.subsampling, &colorspace),
              0);
    out.rgb.resize(size_t{3} * static_cast<size_t>(out.width) * static_cast<size_t>(out.height));
    EXPECT_EQ(tjDecompress2(handle.get(), data, jpeg.size(), out.rgb.data(), out.width, 0,
                            out.height, TJPF_RGB, 0),
              0);
    return out;
}

} // namespace froxel::encode
