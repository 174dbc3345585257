#include "app/bench_picture.h"

#include "app/shown_picture.h"
#include "app/timings_report.h"
#include "reference/shade.h"
#include "render/renderer.h"
#include "render/visibility_readback.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

namespace froxel::app {

namespace {

std::string keyOf(const char* how, const view::ViewSettings& settings, double time_s) {
    return fmt::format("{} {} {}", how, time_s, settingsReport(settings).dump());
}

std::vector<std::byte> withoutPadding(const PixelView& pixels) {
    std::vector<std::byte> rgba8;
    const size_t row_bytes = size_t{pixels.width_px} * 4;
    rgba8.reserve(row_bytes * pixels.height_px);
    for (uint32_t y = 0; y < pixels.height_px; ++y) {
        const std::byte* row = pixels.data + y * pixels.stride_bytes;
        rgba8.insert(rgba8.end(), row, row + row_bytes);
    }
    return rgba8;
}

} // namespace

template <class Make>
Result<BenchPictures::Shared> BenchPictures::once(const std::string& key, const Make& make) {
    const auto known = std::ranges::find(kept_, key, &Kept::key);
    if (known != kept_.end()) {
        return known->picture;
    }
    auto made = make();
    if (made) {
        if (kept_.size() == kKept) {
            kept_.pop_front();
        }
        kept_.push_back({key, *made});
    }
    return made;
}

Result<BenchPictures::Shared> BenchPictures::draw(const view::ViewSettings& settings,
                                                  double time_s) {
    render::ViewRenderer viewer(renderer_);
    render::FrameInputs inputs{.settings = settings, .time_s = time_s};
    inputs.keep_radiance = true;
    // As naive is drawn: a GPU's texture unit may round a sample by whether the pixels beside it
    // passed the depth test (README, "Measured"), which says nothing of assignment or loop order.
    inputs.depth_prepass = false;
    if (const auto submitted = viewer.submit(inputs); !submitted) {
        return submitted.error();
    }
    const auto frame = viewer.collect();
    if (!frame) {
        return frame.error();
    }
    auto linear = viewer.readLinear();
    if (!linear) {
        return linear.error();
    }
    return std::make_shared<const BenchPicture>(
        BenchPicture{std::move(*linear), withoutPadding(frame->pixels.view()), frame->stats.grid});
}

Result<BenchPictures::Shared> BenchPictures::drawOnce(const view::ViewSettings& settings,
                                                      double time_s) {
    return once(keyOf("drawn", settings, time_s), [&] { return draw(settings, time_s); });
}

Result<BenchPictures::Shared> BenchPictures::shade(const view::ViewSettings& settings,
                                                   double time_s) {
    const auto visibility =
        render::readVisibility(renderer_, scene_, {.settings = settings, .time_s = time_s});
    if (!visibility) {
        return visibility.error();
    }
    auto linear = reference::shade(scene_, settings, time_s, *visibility);
    if (!linear) {
        return linear.error();
    }
    auto rgba8 = shownPicture(*linear, static_cast<double>(settings.exposure), settings.tone_map);
    return std::make_shared<const BenchPicture>(
        BenchPicture{std::move(*linear), std::move(rgba8), {}});
}

Result<BenchPictures::Shared> BenchPictures::shadeOnce(const view::ViewSettings& settings,
                                                       double time_s) {
    return once(keyOf("shaded", settings, time_s), [&] { return shade(settings, time_s); });
}

} // namespace froxel::app
