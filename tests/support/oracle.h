// Pictures and lists against double precision.
#pragma once

#include "core/linear_image.h"
#include "core/visibility.h"
#include "render/view/renderer.h"
#include "support/draw.h"

#include <functional>

namespace froxel::test {

// What the device sees and what double precision makes of it (R2); fails the test on an error.
struct Reference {
    Visibility visibility;
    LinearImage picture;
};
[[nodiscard]] Reference
refer(render::Renderer& renderer, const scene::Scene& scene, const render::FrameInputs& inputs);

// (light, pixel) pairs where a light's share is not 0 in double, its radius taken larger by 1e-6,
// but which the list of the pixel's cluster lacks. By brute force, with the host's lists, which the
// device's equal entry by entry (tests/render/gpu_assignment_test.cpp).
struct PairCheck {
    size_t contributing = 0;
    size_t missing = 0;
};
[[nodiscard]] PairCheck checkPairs(const scene::Scene& scene,
                                   const render::FrameInputs& inputs,
                                   const Visibility& visibility);

// The largest |device - reference| / allowed(reference), over every channel where a surface is.
struct Worst {
    double ratio = 0;
    double device = 0;
    double reference = 0;
    uint32_t x = 0;
    uint32_t y = 0;
};
[[nodiscard]] Worst worstOf(const Picture& picture,
                            const Reference& reference,
                            const std::function<double(double)>& allowed);
std::ostream& operator<<(std::ostream& out, const Worst& worst);

// Within `relative` of the reference, or `absolute` where that is more.
[[nodiscard]] inline std::function<double(double)> within(double relative, double absolute) {
    return [=](double reference) { return relative * std::abs(reference) + absolute; };
}

// checkPairs(): some pairs contribute, none is missing.
void expectNoneMissing(const scene::Scene& scene,
                       const render::FrameInputs& inputs,
                       const Visibility& visibility);

} // namespace froxel::test
