// The filter of textures in the reference against the device's own.
#include "gpu/command_context.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "gpu/upload.h"
#include "reference/texture.h"
#include "render/scene/texture_store.h"
#include "support/gpu_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>

namespace froxel::test {

namespace {

#include "texture_samples.spv.h"

class TextureFilter : public GpuTest {};

struct TextureSample {
    glm::vec2 uv{0};
    glm::vec2 dx{0};
    glm::vec2 dy{0};
    glm::vec4 value{0};
};

// As the device samples the scene's first texture.
std::vector<TextureSample>
sampled(const gpu::Device& device, const scene::Scene& scene, std::vector<TextureSample> samples) {
    gpu::Timeline timeline(device);
    gpu::MemoryArena arena(device);
    gpu::Uploader uploader(device, vk::DeviceSize{1} << 20U);
    render::TextureStore store(device, arena);
    const auto texture = store.get(scene, {.texture = 0}, false, uploader);
    uploader.finish(timeline);
    const auto bytes = samples.size() * sizeof(TextureSample);
    const auto buffer = arena.makeBuffer(bytes, vk::BufferUsageFlagBits::eStorageBuffer,
                                         gpu::MemoryUse::kReadback, "samples");
    std::memcpy(buffer.mapped, samples.data(), bytes);
    using Type = vk::DescriptorType;
    constexpr auto kStage = vk::ShaderStageFlagBits::eCompute;
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding{0, Type::eStorageBuffer, 1, kStage},
        vk::DescriptorSetLayoutBinding{1, Type::eCombinedImageSampler, 1, kStage}};
    const std::array sizes = {vk::DescriptorPoolSize{Type::eStorageBuffer, 1},
                              vk::DescriptorPoolSize{Type::eCombinedImageSampler, 1}};
    const auto set_layout = gpu::makeSetLayout(device, bindings);
    const auto layout = gpu::makePipelineLayout(device, {*set_layout});
    const auto pipeline =
        gpu::makeComputePipeline(device, texture_samples_words, {}, *layout, "texture samples");
    const auto pool = gpu::makeDescriptorPool(device, sizes);
    const auto set = gpu::makeSet(device, pool, *set_layout);
    const vk::DescriptorBufferInfo info{*buffer.handle, 0, VK_WHOLE_SIZE};
    const std::array writes = {vk::WriteDescriptorSet{.dstSet = *set,
                                                      .dstBinding = 0,
                                                      .descriptorCount = 1,
                                                      .descriptorType = Type::eStorageBuffer,
                                                      .pBufferInfo = &info},
                               vk::WriteDescriptorSet{.dstSet = *set,
                                                      .dstBinding = 1,
                                                      .descriptorCount = 1,
                                                      .descriptorType = Type::eCombinedImageSampler,
                                                      .pImageInfo = &texture}};
    device.handle().updateDescriptorSets(writes, {});
    timeline.runNow([&](const auto& cmd) {
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *set, {});
        cmd.dispatch(static_cast<uint32_t>((samples.size() + 63) / 64), 1, 1);
    });
    std::memcpy(samples.data(), buffer.mapped, bytes);
    return samples;
}

scene::Scene sceneOf(scene::Image image) {
    scene::Scene scene;
    scene.images = {std::move(image)};
    scene.samplers = {{}};
    scene.textures = {{0, 0}};
    return scene;
}

constexpr uint32_t kSide = 256;
constexpr uint32_t kLevels = 9;
constexpr uint32_t kLevelStep = 30; // of a level's colour to the next one's

// Of one colour a level, which tells the level of detail.
scene::Image levelsByColour() {
    scene::Image image{"levels", kSide, kSide, {}};
    for (uint32_t level = 0; level < kLevels; ++level) {
        const size_t side = kSide >> level;
        std::vector bytes(4 * side * side, static_cast<std::byte>(kLevelStep * level));
        if (level == 0) {
            image.rgba8 = std::move(bytes);
        } else {
            image.mips.emplace_back(std::move(bytes));
        }
    }
    return image;
}

scene::Image noise() {
    std::mt19937 random(7);
    scene::Image image{"noise", kSide, kSide, {}};
    for (size_t i = 0; i < size_t{4} * kSide * kSide; ++i) {
        image.rgba8.own().push_back(static_cast<std::byte>(random() % 256));
    }
    return image;
}

// Of up to 32 texels, up to 16 times as long as wide, some of them skewed.
std::vector<TextureSample> randomFootprints() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share;
    std::vector<TextureSample> samples(20'000);
    for (auto& s : samples) {
        const double length = std::exp2(6 * share(random) - 1) / kSide;
        const double other = length * std::exp2(-4 * share(random));
        const double turn = 2 * std::numbers::pi * share(random);
        const double to_other = 2 * std::numbers::pi * share(random);
        s.uv = {share(random), share(random)};
        s.dx = length * glm::dvec2(std::cos(turn), std::sin(turn));
        s.dy = other * glm::dvec2(std::cos(to_other), std::sin(to_other));
        if (random() % 2 != 0) {
            std::swap(s.dx, s.dy);
        }
    }
    return samples;
}

struct Errors {
    double rmse = 0;
    double p99 = 0;
    double max = 0;
};

Errors errorsOf(const gpu::Device& device, const scene::Image& image) {
    const auto samples = sampled(device, sceneOf(image), randomFootprints());
    const auto filter = render::textureFilter(device);
    const reference::MipChain chain(image, false);
    std::vector<double> errors;
    double squares = 0;
    for (const auto& s : samples) {
        const auto expected =
            chain.sample({}, {glm::dvec2(s.uv), glm::dvec2(s.dx), glm::dvec2(s.dy)}, filter);
        const double error = std::abs(static_cast<double>(s.value.x) - expected.x);
        errors.push_back(error);
        squares += error * error;
    }
    std::ranges::sort(errors);
    const Errors out{std::sqrt(squares / static_cast<double>(errors.size())),
                     errors[errors.size() * 99 / 100], errors.back()};
    std::printf("filter: RMSE %.3g p99 %.3g max %.3g\n", out.rmse, out.p99, out.max);
    return out;
}

} // namespace

TEST_F(TextureFilter, LevelsOfDetail_OfRandomFootprints_AreTheReferences) {
    const Errors errors = errorsOf(device(), levelsByColour());
    const double level = kLevelStep / 255.0;
    EXPECT_LT(errors.max, (onGpu() ? 0.02 : 0.07) * level); // llvmpipe's log2 is an approximation
}

TEST_F(TextureFilter, Noise_SeenByRandomFootprints_IsTheReferences) {
    const Errors errors = errorsOf(device(), noise());
    EXPECT_LT(errors.rmse, 0.01);
}

} // namespace froxel::test
