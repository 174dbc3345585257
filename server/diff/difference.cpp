#include "diff/difference.h"

#include "core/packed_pixels.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <utility>

namespace froxel::diff {
namespace {

Difference
measureRadiance(const LinearImage& picture, const LinearImage& reference, double tolerance) {
    Difference difference;
    difference.size = {picture.width_px, picture.height_px};
    difference.radiance = true;
    difference.values = image_metrics::linearDifference(picture, reference);
    difference.beyond = image_metrics::differing(picture, reference, tolerance);
    if (difference.equal()) {
        return difference;
    }
    const auto [width, height] = difference.size;
    difference.mssim = image_metrics::structuralSimilarity(
        packedView(image_metrics::shownAsReference(picture, reference), width, height),
        packedView(image_metrics::shownAsReference(reference, reference), width, height));
    auto errors = image_metrics::hdrFlipErrors(picture, reference);
    difference.flip =
        errors ? image_metrics::meanOf(*errors) : std::numeric_limits<double>::quiet_NaN();
    if (errors) {
        difference.flip_errors = std::move(*errors);
    }
    return difference;
}

// What a value of a pixel is for people: 0 to 255, or radiance.
std::string colourText(const std::array<float, 3>& colour, bool radiance) {
    const auto text = [radiance](float value) {
        return radiance ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", 255 * value);
    };
    return text(colour[0]) + " " + text(colour[1]) + " " + text(colour[2]);
}

void addBroken(std::vector<std::string>& lines,
               const char* what,
               double value,
               const std::optional<double>& limit) {
    if (limit && !(value <= *limit)) {
        lines.push_back(
            fmt::format("{} is {:.3g}, at most {:.3g} is allowed", what, value, *limit));
    }
}

} // namespace

Difference measure(const PixelView& picture, const PixelView& reference, double tolerance) {
    Difference difference;
    difference.size = {picture.width_px, picture.height_px};
    difference.values = image_metrics::shownDifference(picture, reference);
    difference.beyond =
        image_metrics::differing(picture, reference, static_cast<uint32_t>(tolerance));
    if (!difference.equal()) {
        difference.mssim = image_metrics::structuralSimilarity(picture, reference);
        difference.flip_errors = image_metrics::flipErrors(picture, reference);
        difference.flip = image_metrics::meanOf(difference.flip_errors);
    }
    return difference;
}

Result<Difference> measure(const Picture& picture, const Picture& reference, double tolerance) {
    if (picture.index() != reference.index()) {
        const auto kind = [](const Picture& of) {
            return std::holds_alternative<LinearImage>(of) ? "linear radiance" : "display colours";
        };
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("the pictures hold {} and {}; expected the same of both",
                                 kind(picture), kind(reference))};
    }
    const PictureSize size = sizeOf(picture);
    const PictureSize wanted = sizeOf(reference);
    if (size != wanted) {
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("the pictures have {}x{} and {}x{} pixels; expected one size",
                                 size.width_px, size.height_px, wanted.width_px, wanted.height_px)};
    }
    if (const auto* shown = std::get_if<ShownPicture>(&picture)) {
        return measure(shown->view(), std::get<ShownPicture>(reference).view(), tolerance);
    }
    return measureRadiance(std::get<LinearImage>(picture), std::get<LinearImage>(reference),
                           tolerance);
}

std::vector<std::string> broken(const Difference& difference, const Limits& limits) {
    std::vector<std::string> lines;
    if (difference.values.nonfinite_count > 0) {
        lines.push_back(fmt::format("{} of {} pixels are not finite in one of the pictures",
                                    difference.values.nonfinite_count,
                                    difference.values.pixel_count));
        return lines;
    }
    addBroken(lines, "FLIP", difference.flip, limits.max_flip);
    addBroken(lines, "RMSE", difference.values.rmse, limits.max_rmse);
    auto most = limits.max_differing;
    if (!limits.max_flip && !limits.max_rmse && !most) {
        most = 0;
    }
    addBroken(lines, "the share of pixels that differ",
              static_cast<double>(difference.beyond.count) /
                  static_cast<double>(difference.values.pixel_count),
              most);
    return lines;
}

std::string wordsOf(const Difference& difference) {
    const auto& values = difference.values;
    if (difference.equal()) {
        return fmt::format("equal, {} pixels compared", values.pixel_count);
    }
    std::string words =
        fmt::format("FLIP {:.3g}, RMSE {:.3g}, SSIM {:.3g}, {} of {} pixels differ, by at most ",
                    difference.flip, values.rmse, difference.mssim, difference.beyond.count,
                    values.pixel_count);
    words += difference.radiance ? fmt::format("{:.3g}", values.max_abs)
                                 : fmt::format("{:.0f}/255", 255 * values.max_abs);
    if (values.nonfinite_count > 0) {
        words += fmt::format(", {} are not finite", values.nonfinite_count);
    }
    if (const auto& first = difference.beyond.first) {
        words += fmt::format("; the first is ({}, {}): {} instead of {}", first->x, first->y,
                             colourText(first->picture, difference.radiance),
                             colourText(first->reference, difference.radiance));
    }
    return words;
}

std::vector<std::byte> shownOf(const Picture& picture, const Picture& reference) {
    if (const auto* shown = std::get_if<ShownPicture>(&picture)) {
        return shown->rgba8;
    }
    return image_metrics::shownAsReference(std::get<LinearImage>(picture),
                                           std::get<LinearImage>(reference));
}

} // namespace froxel::diff
