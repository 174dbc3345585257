#include "environment/reader.h"

#include "core/text.h"
#include "environment/formats.h"
#include "exr/reader.h"

#include <cmath>
#include <new>
#include <utility>

namespace froxel::environment {
namespace {

Result<Panorama> decode(std::span<const std::byte> file) {
    try {
        if (isRadiance(file)) {
            return readRadiance(file);
        }
        if (exr::isExr(file)) {
            auto picture = exr::read(file, checkSize);
            if (!picture) {
                return picture.error();
            }
            return Panorama{std::move(picture->image), std::move(picture->warnings)};
        }
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::kCapacity, "does not fit into memory"};
    }
    return Error{ErrorCode::kUnsupported,
                 "is neither a Radiance (.hdr) nor an OpenEXR (.exr) file (" +
                     numberText(file.size()) + " bytes)"};
}

void replaceImpossible(Panorama& panorama) {
    size_t nans = 0;
    size_t negatives = 0;
    size_t infinities = 0;
    for (float& value : panorama.image.rgb) {
        if (std::isnan(value)) {
            ++nans;
            value = 0;
        } else if (value < 0) {
            ++negatives;
            value = 0;
        } else if (std::isinf(value)) {
            ++infinities;
            value = kInfiniteRadiance;
        }
    }
    const auto warn = [&](size_t count, const char* what, const std::string& as) {
        if (count > 0) {
            panorama.warnings.push_back("has " + numberText(count) + " of " +
                                        numberText(panorama.image.rgb.size()) + " values " + what +
                                        ", read as " + as);
        }
    };
    warn(nans, "that are not numbers", "0");
    warn(negatives, "below 0", "0");
    warn(infinities, "that are infinite", numberText(kInfiniteRadiance));
}

} // namespace

Result<void> checkSize(int64_t width_px, int64_t height_px) {
    const auto is = [&] {
        return "has " + numberText(width_px) + "x" + numberText(height_px) + " pixels; ";
    };
    if (width_px < 2 || width_px != 2 * height_px) {
        return Error{ErrorCode::kInvalidArgument,
                     is() + "expected an equirectangular panorama, twice as wide as high"};
    }
    if (width_px > int64_t{kMaxPanoramaWidth_px}) {
        return Error{ErrorCode::kCapacity, is() + "a panorama may have at most " +
                                               numberText(kMaxPanoramaWidth_px) + "x" +
                                               numberText(kMaxPanoramaWidth_px / 2)};
    }
    return {};
}

Result<Panorama> read(std::span<const std::byte> file, const std::string& user) {
    auto panorama = decode(file);
    if (!panorama) {
        return Error{panorama.error().code, user + " " + panorama.error().message};
    }
    replaceImpossible(*panorama);
    for (std::string& warning : panorama->warnings) {
        warning = user + " " + warning;
    }
    return panorama;
}

} // namespace froxel::environment
