#include "stream/compared_picture.h"

#include "core/packed_pixels.h"
#include "diff/composition.h"
#include "encode/jpeg_encoder.h"
#include "image_metrics/picture_error.h"
#include "jpeg/reader.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace froxel::stream {
namespace {

using Pixels = std::vector<std::byte>;

// As a client sees a side that is sent as such a JPEG.
PixelView coded(const PixelView& pixels, const settings::Encoding& encoding, Pixels& rgba8) {
    encode::JpegEncoder encoder;
    rgba8.resize(size_t{4} * pixels.width_px * pixels.height_px);
    const auto file = encoder.encode(pixels, encoding);
    const bool shown = file && jpeg::readPixels(*file, rgba8);
    return shown ? packedView(rgba8, pixels.width_px, pixels.height_px) : pixels;
}

uint32_t rgbOf(const std::array<float, 3>& color) {
    const auto byte = [&color](size_t c) {
        return static_cast<uint32_t>(std::lround(255 * color[c]));
    };
    return byte(0) << 16U | byte(1) << 8U | byte(2);
}

void measure(const PixelView& left, const PixelView& right, session::ComparedRecord& record) {
    const auto differing = image_metrics::differing(left, right, 0);
    record.differing_count = differing.count;
    if (const auto& first = differing.first) {
        record.first = {first->x, first->y, rgbOf(first->picture), rgbOf(first->reference)};
        const auto values = image_metrics::shownDifference(left, right);
        record.max_abs = values.max_abs;
        record.rmse = values.rmse;
    } else {
        record.flip = 0;
    }
}

} // namespace

PixelLease compose(ComparedSides& sides, PixelLease right, session::ComparedRecord& record) {
    PixelView left_view = sides.left.view();
    PixelView right_view = right.view();
    Pixels left_coded;
    Pixels right_coded;
    if (sides.left_encoding != sides.right_encoding) {
        left_view = coded(left_view, sides.left_encoding, left_coded);
        right_view = coded(right_view, sides.right_encoding, right_coded);
    }
    measure(left_view, right_view, record);
    const bool heat = sides.show == session::CompareShow::kHeatMap;
    std::optional<image_metrics::Plane<float>> errors;
    if (heat || (sides.flip_wanted && record.differing_count > 0)) {
        errors = image_metrics::flipErrors(left_view, right_view);
        record.flip = image_metrics::meanOf(*errors);
    }
    const auto [width, height] = std::pair(left_view.width_px, left_view.height_px);
    record.layered = !heat && !sides.divided;
    Pixels pixels = heat            ? image_metrics::heatMap(*errors)
                    : sides.divided ? diff::divided(left_view, right_view, sides.split)
                                    : diff::stacked(left_view, right_view);
    sides.left.end();
    right.end();
    const PixelView view = packedView(pixels, width, record.layered ? 2 * height : height);
    return owningLease(view, std::move(pixels));
}

} // namespace froxel::stream
