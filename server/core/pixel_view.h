// Pixels on their way out: how render hands a finished picture to encode without either knowing
// the other.
#pragma once

#include "core/outputs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace froxel {

// Borrowed planes of a byte a sample: luma, blue's and red's difference, full range (JFIF), top row
// first. Chroma of 4:2:0 has half of either side, rounded up.
struct PlaneView {
    std::array<const std::byte*, 3> data{};
    std::array<size_t, 3> stride_bytes{};
};

// Borrowed RGBA8 pixels, sRGB-encoded, alpha 255, top row first.
struct PixelView {
    const std::byte* data = nullptr;
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    size_t stride_bytes = 0;
    // By Output, where it was asked for, else null: rows without padding, so many samples across a
    // pixel and down it, but for the mesh, which has its own size.
    std::array<const float*, kOutputCount> outputs{};
    uint32_t output_samples = 1;
    // In place of `data`, made on the device: planes, or the picture as this file.
    std::optional<PlaneView> planes = {};
    std::span<const std::byte> jpeg = {}; // empty: there was no room for it

    [[nodiscard]] const float* output(Output which) const {
        return outputs[static_cast<size_t>(which)];
    }
};

// Move-only claim on a readback slot; the slot is free again when the lease ends.
// Any thread may end it.
class PixelLease {
  public:
    PixelLease() = default;
    PixelLease(PixelView view, std::function<void()> release)
        : view_(view), release_(std::move(release)) {}
    PixelLease(PixelLease&& other) noexcept
        : view_(std::exchange(other.view_, {})), release_(std::exchange(other.release_, nullptr)) {}
    PixelLease& operator=(PixelLease&& other) noexcept {
        if (this != &other) {
            end();
            view_ = std::exchange(other.view_, {});
            release_ = std::exchange(other.release_, nullptr);
        }
        return *this;
    }
    PixelLease(const PixelLease&) = delete;
    PixelLease& operator=(const PixelLease&) = delete;
    ~PixelLease() { end(); }

    [[nodiscard]] const PixelView& view() const { return view_; }
    void end() {
        if (auto release = std::exchange(release_, nullptr)) {
            release();
        }
        view_ = {};
    }

  private:
    PixelView view_;
    std::function<void()> release_;
};

// Of what `owner` keeps, which may move without its pixels doing so; it goes when the lease ends.
template <class Owner>
[[nodiscard]] PixelLease owningLease(const PixelView& view, Owner owner) {
    return {view, [kept = std::make_shared<Owner>(std::move(owner))] {}};
}

} // namespace froxel
