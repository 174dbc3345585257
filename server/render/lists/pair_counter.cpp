#include "render/lists/pair_counter.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "interface/pairs_io.h"
#include "render/pipelines/screen_groups.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::render {

namespace {

vk::raii::DescriptorSetLayout setLayout(const gpu::Device& device) {
    const std::array bindings = {vk::DescriptorSetLayoutBinding{
        0, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute}};
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorPool makePool(const gpu::Device& device) {
    const vk::DescriptorPoolSize size{vk::DescriptorType::eStorageBuffer, 1};
    return gpu::makeDescriptorPool(device, std::array{size});
}

uint64_t join(uint32_t low, uint32_t high) {
    return uint64_t{high} << 32U | low;
}

} // namespace

PairPipelines::PairPipelines(const gpu::Device& device,
                             const gpu::Timeline& timeline,
                             VariantMaker& maker,
                             const Pipelines& shared)
    : device_(device), set_layout_(render::setLayout(device)),
      layout_(gpu::makePipelineLayout(device,
                                      {shared.frameLayout(), shared.screenLayout(), *set_layout_})),
      made_(timeline, maker, Pipelines::kKeptScreen) {}

vk::Pipeline PairPipelines::pipeline(uint32_t light_flags) {
    const uint32_t flags = countingFlags(light_flags, device_.traits().is_cpu);
    return *made_.findOrMake(flags, [=, this] {
        return gpu::makeComputePipeline(device_, shaders::count_pairs_comp(),
                                        {0, flags, 0, std::max(1U, device_.traits().subgroup_size)},
                                        *layout_, "count pairs");
    });
}

PairCounter::PairCounter(const gpu::Device& device, const PairPipelines& shared)
    : arena_(device), counts_(arena_.makeBuffer(sizeof(io::PairCounts),
                                                vk::BufferUsageFlagBits::eStorageBuffer |
                                                    vk::BufferUsageFlagBits::eTransferDst,
                                                gpu::MemoryUse::kReadback,
                                                "pair counts")),
      pool_(makePool(device)) {
    set_ = gpu::makeSet(device, pool_, shared.setLayout());
    const vk::DescriptorBufferInfo buffer{*counts_.handle, 0, VK_WHOLE_SIZE};
    device.handle().updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = *set_,
                               .dstBinding = 0,
                               .descriptorCount = 1,
                               .descriptorType = vk::DescriptorType::eStorageBuffer,
                               .pBufferInfo = &buffer},
        {});
}

void PairCounter::recordClear(const vk::raii::CommandBuffer& cmd) const {
    cmd.fillBuffer(*counts_.handle, 0, VK_WHOLE_SIZE, 0);
}

void PairCounter::recordCount(const vk::raii::CommandBuffer& cmd,
                              PairPipelines& shared,
                              vk::DescriptorSet frame_set,
                              vk::DescriptorSet screen_set,
                              uint32_t light_flags,
                              const vk::Rect2D& region) const {
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, shared.pipeline(light_flags));
    const std::array sets = {frame_set, screen_set, *set_};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, shared.layout(), 0, sets, {});
    dispatchOver(cmd, region);
}

PairStats PairCounter::read() const {
    io::PairCounts counts{};
    std::memcpy(&counts, counts_.mapped, sizeof(counts));
    return {.counted = true,
            .evaluated = join(counts.evaluated_low, counts.evaluated_high),
            .contributing = join(counts.contributing_low, counts.contributing_high)};
}

} // namespace froxel::render
