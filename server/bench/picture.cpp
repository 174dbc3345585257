#include "bench/picture.h"

#include "bench/shown_picture.h"
#include "image_metrics/flip.h"
#include "motion/posed_scene.h"
#include "reference/bloom.h"
#include "reference/exposure.h"
#include "reference/shade.h"
#include "render/view/renderer.h"
#include "render/view/visibility_readback.h"
#include "report/settings_report.h"
#include "scene/material_variants.h"
#include "settings/samples.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace froxel::bench {

namespace {

std::string keyOf(const char* how, const settings::ViewSettings& settings, double time_s) {
    return fmt::format("{} {} {} {}", how, time_s, settings.material_variant,
                       report::settingsReport(settings).dump());
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

// As it stands at a time; seeded lights keep their box.
scene::Scene standing(const scene::Scene& scene, double time_s) {
    scene::Scene posed = motion::posedScene(scene, motion::usualClips(*scene.motion), time_s);
    posed.bounds_world = scene.bounds_world;
    return posed;
}

} // namespace

template <class Make>
Result<Pictures::Shared> Pictures::once(const std::string& key, const Make& make) {
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

Result<Pictures::Shared> Pictures::drawFrame(const settings::ViewSettings& settings,
                                             double time_s) {
    render::ViewRenderer viewer(renderer_);
    render::FrameInputs inputs{.settings = settings, .time_s = time_s};
    inputs.outputs = {Output::kRadiance};
    // As naive is drawn: a GPU's texture unit may round a sample by whether the pixels beside it
    // passed the depth test (docs/figures/error.md), which says nothing of assignment or of the
    // loop's order.
    inputs.depth_prepass = false;
    if (const auto submitted = viewer.submit(inputs); !submitted) {
        return submitted.error();
    }
    const auto frame = viewer.collect();
    if (!frame) {
        return frame.error();
    }
    const PixelView& pixels = frame->pixels.view();
    return std::make_shared<const Picture>(
        Picture{radianceOf(pixels), withoutPadding(pixels), frame->stats.grid});
}

Result<Pictures::Shared> Pictures::draw(const settings::ViewSettings& settings, double time_s) {
    const uint32_t count = settings::framesOf(settings);
    if (count == 1) {
        return drawFrame(settings, time_s);
    }
    std::vector<settings::Camera> samples;
    for (uint32_t i = 0; i < count; ++i) {
        samples.push_back(settings::sampled(settings.camera, settings.size, i));
    }
    return mean(settings, time_s, samples);
}

Result<Pictures::Shared> Pictures::drawOnce(const settings::ViewSettings& settings, double time_s) {
    return once(keyOf("drawn", settings, time_s), [&] { return draw(settings, time_s); });
}

Result<Pictures::Shared> Pictures::shade(const settings::ViewSettings& settings, double time_s) {
    const auto visibility =
        render::readVisibility(renderer_, scene_, {.settings = settings, .time_s = time_s});
    if (!visibility) {
        return visibility.error();
    }
    std::optional<scene::Scene> shown; // none: as it is
    if (settings.material_variant > 0) {
        shown = scene::inMaterialVariant(scene_, settings.material_variant);
    }
    if (scene_.motion) {
        shown = standing(shown ? *shown : scene_, time_s);
    }
    const scene::Scene& scene = shown ? *shown : scene_;
    auto linear = reference::shade(scene, settings, time_s, *visibility);
    if (!linear) {
        return linear.error();
    }
    auto exposure = static_cast<double>(settings.exposure);
    if (settings.exposure_mode == settings::ExposureMode::kFrame) {
        exposure *= reference::meteredFactor(scene, *linear, *visibility);
    }
    if (settings.bloom.kind != settings::BloomKind::kNone) {
        *linear = reference::spread(*linear, settings.bloom, exposure);
    }
    auto rgba8 = shownPicture(*linear, exposure, settings.tone_map);
    return std::make_shared<const Picture>(Picture{std::move(*linear), std::move(rgba8), {}});
}

Result<Pictures::Shared> Pictures::mean(const settings::ViewSettings& settings,
                                        double time_s,
                                        const std::vector<settings::Camera>& samples) {
    const size_t value_count = size_t{settings.size.width_px} * settings.size.height_px * 3;
    std::vector<double> linear(value_count);
    std::vector<double> emitted(value_count);
    auto sampled = settings;
    for (const auto& camera : samples) {
        sampled.camera = camera;
        const auto picture = drawFrame(sampled, time_s);
        if (!picture) {
            return picture;
        }
        for (size_t k = 0; k < value_count; ++k) {
            linear[k] += static_cast<double>((*picture)->linear.rgb[k]);
            const auto byte = std::to_integer<uint8_t>((*picture)->rgba8[k / 3 * 4 + k % 3]);
            emitted[k] += static_cast<double>(
                image_metrics::flip::linearFromSrgb(static_cast<float>(byte) / 255));
        }
    }
    const auto over_all = [&](const std::vector<double>& sums) {
        LinearImage image{settings.size.width_px, settings.size.height_px, {}};
        for (const double sum : sums) {
            image.rgb.push_back(static_cast<float>(sum / static_cast<double>(samples.size())));
        }
        return image;
    };
    return std::make_shared<const Picture>(Picture{
        over_all(linear), shownPicture(over_all(emitted), 1, settings::ToneMap::kClamp), {}});
}

Result<Pictures::Shared> Pictures::sampleOnce(const settings::ViewSettings& settings,
                                              double time_s) {
    return once(keyOf("sampled", settings, time_s), [&] {
        std::vector<settings::Camera> samples;
        for (uint32_t i = 0; i < kSamplesAcross * kSamplesAcross; ++i) {
            const glm::dvec2 in_pixel(i % kSamplesAcross, i / kSamplesAcross);
            const glm::dvec2 place_px = (in_pixel + 0.5) / double{kSamplesAcross} - 0.5;
            samples.push_back(settings::centredAt(settings.camera, settings.size, place_px));
        }
        return mean(settings, time_s, samples);
    });
}

Result<Pictures::Shared> Pictures::shadeOnce(const settings::ViewSettings& settings,
                                             double time_s) {
    return once(keyOf("shaded", settings, time_s), [&] { return shade(settings, time_s); });
}

} // namespace froxel::bench
