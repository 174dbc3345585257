#include "render/radiance_readback.h"

#include "render/frame/frame_slot.h"
#include "render/pipelines/host_copies.h"

#include <cstring>

namespace froxel::render {

namespace {

// Of each 2 x 2 of them.
LinearImage meanOfSamples(const LinearImage& samples) {
    LinearImage image{samples.width_px / 2, samples.height_px / 2, {}};
    image.rgb.reserve(samples.rgb.size() / 4);
    const size_t row = size_t{samples.width_px} * 3;
    for (size_t y = 0; y < image.height_px; ++y) {
        for (size_t x = 0; x < image.width_px; ++x) {
            const float* top = &samples.rgb[2 * y * row + 6 * x];
            const float* low = top + row;
            for (size_t channel = 0; channel < 3; ++channel) {
                image.rgb.push_back(
                    0.25F * (top[channel] + top[channel + 3] + low[channel] + low[channel + 3]));
            }
        }
    }
    return image;
}

} // namespace

LinearImage copyRadiance(SceneResources& scene, const ViewTargets& targets) {
    const size_t pixel_count = size_t{targets.size.width_px} * targets.size.height_px;
    LinearImage image{targets.size.width_px, targets.size.height_px, {}};
    image.rgb.resize(pixel_count * 3);
    const Readback readback(scene.shared.device, pixel_count * 4 * sizeof(float));
    scene.shared.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        recordTargetCopy(cmd, targets.radiance, vk::ImageAspectFlagBits::eColor, readback.buffer);
    });
    for (size_t i = 0; i < pixel_count; ++i) {
        std::memcpy(&image.rgb[i * 3], readback.buffer.mapped + i * 4 * sizeof(float),
                    3 * sizeof(float));
    }
    return targets.size == targets.shown ? image : meanOfSamples(image);
}

} // namespace froxel::render
