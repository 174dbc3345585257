// The passes of bloom as data: which shader reads which picture and writes which. Pure.
#pragma once

#include "core/error.h"
#include "interface/bloom_io.h"
#include "settings/settings.h"

#include <cstdint>
#include <vector>

namespace froxel::render {

enum class BloomShader : uint8_t { kBright, kSingle, kLine, kATrous, kDown, kUp };

// A pass reads one picture and writes another: the frame's own or one of bloom's.
struct BloomWire {
    static constexpr uint32_t kPicture = ~0U;
    uint32_t source = kPicture;
    uint32_t target = kPicture;
    bool operator==(const BloomWire&) const = default;
};

struct BloomStep {
    BloomShader shader = BloomShader::kBright;
    BloomWire wire;
    io::BloomPass pass{};

    // kBloomBright, kBloomAdds
    [[nodiscard]] uint32_t flags() const;
};

struct BloomPlan {
    std::vector<settings::Size> images; // bloom's own pictures
    std::vector<BloomStep> steps;       // in order, each reading what those before wrote

    [[nodiscard]] std::vector<BloomWire> wires() const;
};

// Of a picture of `size`; the kind is not none. What every kind comes to is a Gaussian of standard
// deviation radius x the smaller side, cut at three of them or by splines of the same variance.
[[nodiscard]] BloomPlan
planBloom(const settings::Bloom& bloom, const settings::Size& size, float exposure);

// That a step takes for each pixel of its target.
[[nodiscard]] double tapsOf(const BloomStep& step);

// Errors: kUnsupported where a kernel has more taps than the iterations of a software rasteriser's
// loops.
[[nodiscard]] Result<void> checkKernels(const BloomPlan& plan, bool device_is_cpu);

} // namespace froxel::render
