#include "stream/jpeg_choice.h"

#include "core/clock.h"
#include "core/text.h"
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_format.h"
#include "render/view/jpeg_trial.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace froxel::stream {
namespace {

constexpr settings::Size kSize{1280, 720};
constexpr uint32_t kTimes = 5;

// About as many details as a rendered picture: waves of all lengths, and grain.
std::vector<std::byte> testPicture() {
    std::vector<std::byte> rgba8(size_t{4} * kSize.width_px * kSize.height_px);
    uint32_t grain = 1;
    for (uint32_t i = 0; i < kSize.width_px * kSize.height_px; ++i) {
        const double x = i % kSize.width_px;
        const double y = static_cast<double>(i) / kSize.width_px;
        grain = grain * 1664525U + 1013904223U;
        const double light = 110 + 70 * std::sin(x * x * 1e-4) * std::cos(y * y * 2e-4);
        const double coarse = (grain >> 24U) / 12.0;
        for (size_t channel = 0; channel < 3; ++channel) {
            rgba8[4 * size_t{i} + channel] =
                static_cast<std::byte>(light + coarse + 15.0 * static_cast<double>(channel));
        }
    }
    return rgba8;
}

struct Timed {
    std::vector<std::byte> file;
    Seconds time{0};
};

Result<Timed> onHost(const PixelView& pixels, const settings::Encoding& encoding) {
    encode::JpegEncoder encoder;
    Timed best;
    for (uint32_t i = 0; i < kTimes; ++i) {
        const auto begin = Clock::now();
        auto file = encoder.encode(pixels, encoding);
        if (!file) {
            return file.error();
        }
        const Seconds took = Clock::now() - begin;
        best = {std::move(*file), i == 0 ? took : std::min(best.time, took)};
    }
    return best;
}

Result<bool> compare(render::RenderDevice& on, JpegPlace place, uint32_t encoder_count) {
    const settings::Encoding encoding;
    const auto rgba8 = testPicture();
    const PixelView pixels{.data = rgba8.data(),
                           .width_px = kSize.width_px,
                           .height_px = kSize.height_px,
                           .stride_bytes = size_t{4} * kSize.width_px};
    const auto host = onHost(pixels, encoding);
    const auto format = encode::jpegFormat(encoding);
    if (!host || !format) {
        return host ? format.error() : host.error();
    }
    const auto device = render::tryJpeg(on, pixels, *format, {.times = kTimes});
    if (!device) {
        return device.error();
    }
    if (device->file != host->file) {
        return Error{ErrorCode::kUnsupported,
                     "the JPEG that the device makes differs from TurboJPEG's"};
    }
    const bool sooner = device->time > Seconds(0) && device->time * encoder_count < host->time;
    const bool chosen = place == JpegPlace::kDevice || sooner;
    spdlog::info("event=jpeg_encoder place={} device_us={:.0f} host_us={:.0f} encoders={}",
                 chosen ? "device" : "host", Microseconds(device->time).count(),
                 Microseconds(host->time).count(), encoder_count);
    return chosen;
}

} // namespace

Result<bool>
deviceMakesJpegs(render::RenderDevice& on, bool is_cpu, JpegPlace place, uint32_t encoder_count) {
    if (place == JpegPlace::kHost || (place == JpegPlace::kAuto && is_cpu)) {
        return false;
    }
    auto chosen = compare(on, place, encoder_count);
    if (!chosen && place == JpegPlace::kAuto && chosen.error().code != ErrorCode::kDevice) {
        spdlog::warn("event=jpeg_encoder place=host reason={}", logValue(chosen.error().message));
        return false;
    }
    return chosen;
}

} // namespace froxel::stream
