#include "render/frame/planes.h"

#include "core/ceil_divide.h"

namespace froxel::render {

PlaneSizes::PlaneSizes(const settings::Size& size, uint32_t sampling) {
    const auto words = [](uint32_t bytes) { return ceilDivide(bytes, 4U); };
    picture.width_px = size.width_px;
    picture.height_px = size.height_px;
    picture.luma_row = words(size.width_px);
    picture.chroma_row = words(ceilDivide(size.width_px, sampling));
    picture.chroma_height = ceilDivide(size.height_px, sampling);
}

PlaneView PlaneSizes::view(const std::byte* host) const {
    const size_t luma = size_t{4} * lumaWords();
    const size_t chroma = size_t{4} * chromaWords();
    const size_t chroma_row = size_t{4} * picture.chroma_row;
    return {.data = {host, host + luma, host + luma + chroma},
            .stride_bytes = {size_t{4} * picture.luma_row, chroma_row, chroma_row}};
}

} // namespace froxel::render
