#include "render/lists/assign_pipelines.h"

#include "embedded.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "interface/assign_io.h"
#include "render/pipelines/host_copies.h"
#include "render/pipelines/storage_set.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

namespace froxel::render {

namespace {

constexpr uint32_t kProbes = 4096;

// Positive, of any mantissa, within what depths and coordinates can be.
std::vector<double> probeOperands() {
    std::mt19937_64 random(1);
    std::vector<double> operands(2 * kProbes);
    for (double& operand : operands) {
        const uint64_t mantissa = random() >> 12U;
        const uint64_t exponent = 1023 - 60 + random() % 121;
        operand = std::bit_cast<double>(exponent << 52U | mantissa);
    }
    return operands;
}

} // namespace

std::string AssignPipelines::unusable(const gpu::Device& device, gpu::Timeline& timeline) {
    const auto& limits = device.limits();
    if (!device.traits().float64) {
        return "the device has no doubles in shaders";
    }
    if (limits.maxPerStageDescriptorStorageBuffers < kBindings) {
        return "the device binds too few storage buffers";
    }
    if (limits.maxComputeWorkGroupInvocations < io::kAssignLineGroup) {
        return "the device's workgroups are too small";
    }
    const auto set_layout = storageLayout(device, 2);
    const auto layout = gpu::makePipelineLayout(device, {*set_layout});
    const auto pipeline = gpu::makeComputePipeline(device, shaders::assign_probe_comp(), {},
                                                   *layout, "assignment probe");
    const auto operands = probeOperands();
    gpu::MemoryArena arena(device);
    const auto usage = vk::BufferUsageFlagBits::eStorageBuffer;
    const auto in = arena.makeBuffer(operands.size() * sizeof(double), usage,
                                     gpu::MemoryUse::kUpload, "assignment probe");
    const auto out = arena.makeBuffer(operands.size() * sizeof(double), usage,
                                      gpu::MemoryUse::kReadback, "assignment probe");
    std::memcpy(in.mapped, operands.data(), operands.size() * sizeof(double));
    const StorageSet set(device, *set_layout, 2);
    set.write(std::array{vk::DescriptorBufferInfo{*in.handle, 0, VK_WHOLE_SIZE},
                         vk::DescriptorBufferInfo{*out.handle, 0, VK_WHOLE_SIZE}});
    timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, set.handle(), {});
        cmd.dispatch(kProbes / 64, 1, 1);
        recordHostRead(cmd);
    });
    std::vector<double> results(operands.size());
    std::memcpy(results.data(), out.mapped, results.size() * sizeof(double));
    for (uint32_t i = 0; i < kProbes; ++i) {
        const double a = operands[2 * i];
        if (results[2 * i] != io::assignDivide(a, operands[2 * i + 1]) ||
            results[2 * i + 1] != io::assignSqrt(a)) {
            return "the device rounds doubles differently from the host";
        }
    }
    return {};
}

AssignPipelines::AssignPipelines(const gpu::Device& device)
    : set_layout_(storageLayout(device, kBindings)),
      layout_(gpu::makePipelineLayout(device, {*set_layout_})) {
    using namespace shaders;
    const auto add = [&](gpu::Spirv code, std::string_view name) {
        pipelines_.push_back(gpu::makeComputePipeline(device, code, {}, *layout_, name));
    };
    add(assign_lines_comp(), "assign lines");
    add(assign_bound_comp(), "assign bound");
    add(assign_count_comp(), "assign count");
    add(assign_sum_comp(), "assign sum");
    add(assign_place_comp(), "assign place");
    add(assign_fill_comp(), "assign fill");
    add(assign_order_comp(), "assign order");
    add(assign_order_long_comp(), "assign order long");
}

} // namespace froxel::render
