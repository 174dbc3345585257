// How a session's pictures are delivered: what the viewer allows, and what a frame is made with.
// The settings that the viewer asked for never change by it.
#pragma once

#include "core/clock.h"
#include "settings/ranges.h"
#include "settings/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace froxel::session {

// What the viewer allows; part of the session's state.
struct DeliverySettings {
    bool adaptive = true;  // lower quality, chroma and resolution where they come too late else
    double target_fps = 0; // that a moving view keeps (RateKeeper); 0: none
    settings::Refine refine = settings::Refine::kNone;
    bool operator==(const DeliverySettings&) const = default;
};

// A frame on the way from a moving view to a resting one.
enum class Refinement : uint8_t {
    kInteractive, // within the limits of Delivery
    kSettled,     // the view rests: as asked for
    kHigh,        // kRefinedEncoding, or as asked for where that is better
    kSmooth,      // so, of the mean of several samples a pixel
    kLossless,    // of that mean, too
};
inline constexpr std::array kRefinementNames = {
    std::string_view("interactive"), std::string_view("settled"), std::string_view("high"),
    std::string_view("smooth"), std::string_view("lossless")};

// The limits on frames of a moving view, from link and rate.
struct Delivery {
    double scale = 1; // of each side
    double geometry_error_px = 0;
    uint32_t quality_max = 100;
    settings::Chroma chroma_max = settings::Chroma::k444;
    double video_share = 1;  // of a video's bits a second that were asked for
    Seconds min_interval{0}; // between frames
    uint32_t rung = 0;       // steps below what was asked for, by the link
    // What the link carries, in bits a second; none: unknown, or fast enough not to matter.
    std::optional<double> link_rate;
    bool operator==(const Delivery&) const = default;

    // Whether frames come out below what was asked for.
    [[nodiscard]] bool limits(const settings::Encoding& asked) const {
        return scale < 1 || quality_max < asked.quality || chroma_max < asked.chroma;
    }
};

// What a frame was made with.
struct Delivered {
    double scale = 1;
    settings::Encoding encoding; // of this frame; a refined frame may have another codec
    Refinement refinement = Refinement::kInteractive;
    uint32_t rung = 0;
    double geometry_error_px = 0; // at least, in a picture of the size asked for
};

inline constexpr settings::Encoding kRefinedEncoding{92, settings::Chroma::k444};

// What video may take of a link that is too slow: room is left for what single frames exceed it by.
[[nodiscard]] inline uint32_t carriedKbps(double link_bits_per_s) {
    constexpr double kShare = 0.8;
    constexpr auto kRange = settings::kVideoKbpsRange;
    return static_cast<uint32_t>(
        std::clamp(kShare * link_bits_per_s / 1000, double{kRange.min}, double{kRange.max}));
}

[[nodiscard]] inline settings::Encoding limited(settings::Encoding asked,
                                                const Delivery& delivery) {
    asked.quality = std::min(asked.quality, delivery.quality_max);
    asked.chroma = std::min(asked.chroma, delivery.chroma_max);
    if (delivery.video_share < 1) {
        asked.video_kbps = std::max(settings::kVideoKbpsRange.min,
                                    static_cast<uint32_t>(asked.video_kbps * delivery.video_share));
    }
    if (delivery.rung > 0 && delivery.link_rate) {
        asked.video_kbps = std::min(asked.video_kbps, carriedKbps(*delivery.link_rate));
    }
    return asked;
}

[[nodiscard]] inline settings::Size scaled(settings::Size size, double scale) {
    const auto side = [scale](uint32_t px, uint32_t least_px) {
        const auto less = static_cast<uint32_t>(std::lround(px * scale));
        return std::min(px, std::max(least_px, less));
    };
    return {side(size.width_px, settings::kWidthRange.min),
            side(size.height_px, settings::kHeightRange.min)};
}

// The same view in a smaller picture.
[[nodiscard]] inline settings::ViewSettings scaled(settings::ViewSettings settings, double scale) {
    settings.size = scaled(settings.size, scale);
    settings.geometry_error_px = static_cast<float>(settings.geometry_error_px * scale);
    return settings;
}

// What a frame at this stage is made with.
[[nodiscard]] inline Delivered
delivered(const settings::Encoding& asked, const Delivery& delivery, Refinement stage) {
    switch (stage) {
    case Refinement::kInteractive:
        return {delivery.scale, limited(asked, delivery), stage, delivery.rung,
                delivery.geometry_error_px};
    case Refinement::kSettled:
        return {1, asked, stage, 0};
    case Refinement::kHigh:
    case Refinement::kSmooth:
    case Refinement::kLossless:
        break;
    }
    return {1,
            {std::max(asked.quality, kRefinedEncoding.quality),
             std::max(asked.chroma, kRefinedEncoding.chroma),
             stage == Refinement::kLossless ? settings::kLosslessCodec : settings::kPlainCodec},
            stage,
            0};
}

} // namespace froxel::session
