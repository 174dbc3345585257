#include "render/bloom.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/pipelines.h"
#include "render/screen_groups.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

vk::raii::DescriptorSetLayout setLayout(const gpu::Device& device) {
    const auto stage = vk::ShaderStageFlagBits::eCompute;
    const std::array bindings = {vk::DescriptorSetLayoutBinding{0, Type::eSampledImage, 1, stage},
                                 vk::DescriptorSetLayoutBinding{1, Type::eStorageImage, 1, stage}};
    return gpu::makeSetLayout(device, bindings);
}

struct Shader {
    gpu::Spirv code;
    std::string_view name;
};

Shader shaderOf(BloomShader shader) {
    switch (shader) {
    case BloomShader::kBright:
        return {shaders::bloom_bright_comp(), "bloom bright"};
    case BloomShader::kSingle:
        return {shaders::bloom_single_comp(), "bloom single"};
    case BloomShader::kLine:
        return {shaders::bloom_line_comp(), "bloom line"};
    case BloomShader::kATrous:
        return {shaders::bloom_a_trous_comp(), "bloom a trous"};
    case BloomShader::kDown:
        return {shaders::bloom_down_comp(), "bloom down"};
    case BloomShader::kUp:
        break;
    }
    return {shaders::bloom_up_comp(), "bloom up"};
}

vk::raii::DescriptorPool makePool(const gpu::Device& device, uint32_t set_count) {
    const std::array sizes = {vk::DescriptorPoolSize{Type::eSampledImage, set_count},
                              vk::DescriptorPoolSize{Type::eStorageImage, set_count}};
    return gpu::makeDescriptorPool(device, sizes, set_count);
}

} // namespace

BloomPipelines::BloomPipelines(const gpu::Device& device,
                               const gpu::Timeline& timeline,
                               VariantMaker& maker)
    : device_(device), set_layout_(render::setLayout(device)),
      layout_(gpu::makePipelineLayout(device, {*set_layout_}, sizeof(io::BloomPass))),
      made_(timeline, maker, Pipelines::kKeptScreen) {}

vk::Pipeline BloomPipelines::pipeline(BloomShader shader, uint32_t flags) {
    return *made_.findOrMake(std::pair(shader, flags), [=, this] {
        const auto [code, name] = shaderOf(shader);
        return gpu::makeComputePipeline(device_, code, {0, 0, flags}, *layout_, name);
    });
}

gpu::ImageInfo bloomImage(const view::Size& size) {
    return {.format = Pipelines::kRadianceFormat,
            .extent = {size.width_px, size.height_px},
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eStorage};
}

BloomTargets::BloomTargets(const gpu::Device& device,
                           const BloomPipelines& pipelines,
                           const BloomPlan& plan,
                           std::shared_ptr<const ViewTargets> view)
    : view_(std::move(view)), sizes_(plan.images), wires_(plan.wires()), arena_(device) {
    for (const auto& size : sizes_) {
        images_.push_back(arena_.makeImage(bloomImage(size), "bloom"));
    }
    const auto count = static_cast<uint32_t>(wires_.size());
    pool_ = makePool(device, count);
    const std::vector<vk::DescriptorSetLayout> layouts(count, pipelines.setLayout());
    sets_ = device.handle().allocateDescriptorSets(
        {.descriptorPool = *pool_, .descriptorSetCount = count, .pSetLayouts = layouts.data()});
    const auto info = [&](uint32_t image) {
        const auto& view_of = image == BloomWire::kPicture ? view_->radiance : images_[image];
        return vk::DescriptorImageInfo{.imageView = *view_of.view,
                                       .imageLayout = vk::ImageLayout::eGeneral};
    };
    for (uint32_t i = 0; i < count; ++i) {
        const std::array images = {info(wires_[i].source), info(wires_[i].target)};
        std::array<vk::WriteDescriptorSet, 2> writes;
        for (uint32_t binding = 0; binding < writes.size(); ++binding) {
            writes[binding] = {.dstSet = *sets_[i],
                               .dstBinding = binding,
                               .descriptorCount = 1,
                               .descriptorType =
                                   binding == 0 ? Type::eSampledImage : Type::eStorageImage,
                               .pImageInfo = &images[binding]};
        }
        device.handle().updateDescriptorSets(writes, {});
    }
}

bool BloomTargets::fits(const BloomPlan& plan, const ViewTargets& view) const {
    return view_.get() == &view && sizes_ == plan.images && wires_ == plan.wires();
}

void recordBloomStep(const vk::raii::CommandBuffer& cmd,
                     BloomPipelines& pipelines,
                     const BloomTargets& targets,
                     const BloomPlan& plan,
                     size_t step,
                     const vk::Rect2D& region) {
    const auto& [shader, wire, pass] = plan.steps[step];
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute,
                     pipelines.pipeline(shader, plan.steps[step].flags()));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0,
                           targets.set(step), {});
    cmd.pushConstants<io::BloomPass>(pipelines.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                     pass);
    dispatchOver(cmd, region);
}

std::shared_ptr<BloomTargets> bloomTargetsFor(const gpu::Device& device,
                                              const BloomPipelines& pipelines,
                                              const BloomPlan& plan,
                                              const std::shared_ptr<ViewTargets>& view,
                                              std::shared_ptr<BloomTargets> kept) {
    if (kept && kept->fits(plan, *view)) {
        return kept;
    }
    kept.reset(); // before others are made
    return std::make_shared<BloomTargets>(device, pipelines, plan, view);
}

} // namespace froxel::render
