#include "render/steps/bloom_plan.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::render {

namespace {

constexpr uint32_t kPicture = BloomWire::kPicture;

settings::Size halved(const settings::Size& size) {
    return {(size.width_px + 1) / 2, (size.height_px + 1) / 2};
}

// How many steps reach a variance, and the last one's share where that is mixed with the result of
// those before, so that the variance is just that.
struct Depth {
    uint32_t count = 1;
    double share = 1;
};

// `after(k)`: the variance of k steps; 0 for none, rising.
template <class Variance>
Depth depthFor(double variance, Variance after) {
    Depth depth;
    while (after(depth.count) < variance) {
        ++depth.count;
    }
    const double before = after(depth.count - 1);
    depth.share = (variance - before) / (after(depth.count) - before);
    return depth;
}

double powerOf4(uint32_t k) {
    return std::ldexp(1.0, static_cast<int>(2 * k));
}

class Planner {
  public:
    Planner(const settings::Bloom& bloom, const settings::Size& size, float exposure)
        : size_(size) {
        sigma_px_ = static_cast<double>(bloom.radius) * std::min(size.width_px, size.height_px);
        common_.share = 1;
        common_.threshold = bloom.threshold / exposure;
        common_.knee = common_.threshold * bloom.knee;
        common_.strength = bloom.strength;
        common_.reach = static_cast<uint32_t>(std::ceil(3 * sigma_px_));
        // 2^(falloff d^2) = e^(-d^2 / (2 sigma^2))
        common_.falloff = static_cast<float>(-0.5 / (sigma_px_ * sigma_px_) * std::numbers::log2e);
    }

    BloomPlan single() {
        plan_.images = {size_};
        add(BloomShader::kBright, kPicture, 0);
        add(BloomShader::kSingle, 0, kPicture);
        return plan_;
    }
    BloomPlan separable() {
        plan_.images = {size_};
        add(BloomShader::kLine, kPicture, 0).step_x_px = 1;
        add(BloomShader::kLine, 0, kPicture).step_y_px = 1;
        return plan_;
    }
    // A B-spline's five taps have variance 1; with holes of 2^i, 4^i.
    BloomPlan aTrous() {
        const auto depth =
            depthFor(sigma_px_ * sigma_px_, [](uint32_t k) { return (powerOf4(k) - 1) / 3; });
        plan_.images = {size_};
        if (depth.count > 1) {
            plan_.images.push_back(size_);
        }
        add(BloomShader::kBright, kPicture, 0);
        for (uint32_t i = 0; i < depth.count; ++i) {
            const bool last = i + 1 == depth.count;
            auto& pass = add(BloomShader::kATrous, i % 2, last ? kPicture : (i + 1) % 2);
            pass.step_x_px = pass.step_y_px = 1U << i;
            pass.share = last ? static_cast<float>(depth.share) : 1.0F;
        }
        return plan_;
    }
    // Halving adds 3/4 of a pixel's square to the variance and so does doubling, at each level's
    // size.
    BloomPlan mipChain() {
        const auto depth =
            depthFor(sigma_px_ * sigma_px_, [](uint32_t k) { return (powerOf4(k) - 1) / 2; });
        settings::Size level = size_;
        for (uint32_t i = 0; i < depth.count; ++i) {
            level = halved(level);
            plan_.images.push_back(level);
            add(BloomShader::kDown, i == 0 ? kPicture : i - 1, i);
        }
        for (uint32_t i = depth.count; i > 0; --i) {
            auto& pass = add(BloomShader::kUp, i - 1, i == 1 ? kPicture : i - 2);
            pass.share = i == depth.count ? static_cast<float>(depth.share) : 1.0F;
        }
        return plan_;
    }

  private:
    io::BloomPass& add(BloomShader shader, uint32_t source, uint32_t target) {
        const auto sizeOf = [&](uint32_t image) {
            return image == kPicture ? size_ : plan_.images[image];
        };
        BloomStep step{shader, {source, target}, common_};
        step.pass.source_width_px = sizeOf(source).width_px;
        step.pass.source_height_px = sizeOf(source).height_px;
        step.pass.target_width_px = sizeOf(target).width_px;
        step.pass.target_height_px = sizeOf(target).height_px;
        plan_.steps.push_back(step);
        return plan_.steps.back().pass;
    }

    settings::Size size_;
    double sigma_px_ = 0;
    io::BloomPass common_{};
    BloomPlan plan_;
};

} // namespace

uint32_t BloomStep::flags() const {
    return (wire.source == kPicture ? io::kBloomBright : 0U) |
           (wire.target == kPicture ? io::kBloomAdds : 0U);
}

std::vector<BloomWire> BloomPlan::wires() const {
    std::vector<BloomWire> wires;
    for (const auto& step : steps) {
        wires.push_back(step.wire);
    }
    return wires;
}

BloomPlan planBloom(const settings::Bloom& bloom, const settings::Size& size, float exposure) {
    Planner planner(bloom, size, exposure);
    switch (bloom.kind) {
    case settings::BloomKind::kNone:
        break;
    case settings::BloomKind::kSinglePass:
        return planner.single();
    case settings::BloomKind::kSeparable:
        return planner.separable();
    case settings::BloomKind::kATrous:
        return planner.aTrous();
    case settings::BloomKind::kMipChain:
        return planner.mipChain();
    }
    return {};
}

double tapsOf(const BloomStep& step) {
    const double line = 2.0 * step.pass.reach + 1;
    switch (step.shader) {
    case BloomShader::kBright:
        return 1;
    case BloomShader::kSingle:
        return line * line;
    case BloomShader::kLine:
        return line;
    case BloomShader::kATrous:
        return 25;
    case BloomShader::kDown:
        return 16;
    case BloomShader::kUp:
        return 4;
    }
    return 0;
}

Result<void> checkKernels(const BloomPlan& plan, bool device_is_cpu) {
    constexpr double kMostIterations = 65'535; // llvmpipe's, which says nothing beyond
    for (const auto& step : plan.steps) {
        if (device_is_cpu && tapsOf(step) > kMostIterations) {
            return Error{ErrorCode::kUnsupported,
                         fmt::format("bloom takes {:.0f} taps for a pixel; this device's loops "
                                     "have at most {:.0f}; use mip_chain, a smaller radius, "
                                     "or a smaller picture",
                                     tapsOf(step), kMostIterations)};
        }
    }
    return {};
}

} // namespace froxel::render
