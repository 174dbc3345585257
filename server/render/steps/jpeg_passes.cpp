#include "render/steps/jpeg_passes.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace froxel::render {

namespace {

constexpr uint32_t kBindings = 6; // storage buffers: shaders/lib/jpeg.glsl

// Of coefficients as the transform leaves them: eight times what the quantisation is of, and those
// of the fast one by the cosines of row and column more, in 14 bits (libjpeg-turbo, jcdctmgr.c).
uint32_t divisorOf(const JpegFormat& format, uint32_t quantisation, size_t place) {
    if (format.transform == JpegTransform::kAccurate) {
        return quantisation << 3U;
    }
    constexpr uint32_t kBits = 14 - 3;
    const auto scale = [](size_t k) {
        return k == 0
                   ? 1.0
                   : std::numbers::sqrt2 * std::cos(static_cast<double>(k) * std::numbers::pi / 16);
    };
    const auto both =
        static_cast<uint32_t>(std::lround(0x1p14 * scale(place / 8) * scale(place % 8)));
    return (quantisation * both + (1U << (kBits - 1))) >> kBits;
}

// Division by a constant as multiplication (Fog, "Optimizing subroutines in assembly language",
// 16.9), rounded.
io::JpegDivisor divisorFor(uint32_t divisor, uint32_t place) {
    if (divisor == 1) {
        return {.reciprocal = 1, .correction = 0, .shift = 0, .place = place};
    }
    const auto shift = static_cast<uint32_t>(16 + std::bit_width(divisor) - 1);
    const uint32_t quotient = (1U << shift) / divisor;
    const uint32_t rest = (1U << shift) % divisor;
    const uint32_t half = divisor / 2;
    if (rest == 0) { // a power of two
        return {.reciprocal = quotient / 2, .correction = half, .shift = shift - 1, .place = place};
    }
    return rest <= half ? io::JpegDivisor{quotient, half + 1, shift, place}
                        : io::JpegDivisor{quotient + 1, half, shift, place};
}

io::JpegTables tablesFor(const JpegFormat& format, const JpegFormat::Tables& its) {
    io::JpegTables tables{};
    for (uint32_t i = 0; i < kJpegBlock; ++i) {
        const size_t at = kJpegZigzag[i];
        tables.divisors[at] = divisorFor(divisorOf(format, its.quantisation[at], at), i);
    }
    const auto packed = [](const HuffmanCode& code) {
        return static_cast<uint32_t>(code.length) << 16U | code.bits;
    };
    std::ranges::transform(its.dc, tables.dc_codes, packed);
    std::ranges::transform(its.ac, tables.ac_codes, packed);
    return tables;
}

gpu::Spirv codeOf(JpegPass pass) {
    return pass == JpegPass::kBlocks  ? shaders::jpeg_blocks_comp()
           : pass == JpegPass::kPlace ? shaders::jpeg_place_comp()
                                      : shaders::jpeg_stuff_comp();
}

} // namespace

JpegTablePair jpegTables(const JpegFormat& format) {
    return {tablesFor(format, format.luma), tablesFor(format, format.chroma)};
}

std::string jpegUnusable(const gpu::Device& device) {
    const auto& limits = device.limits();
    if (limits.maxComputeWorkGroupInvocations < io::kJpegSumGroup) {
        return "the device's workgroups are too small";
    }
    if (limits.maxPerStageDescriptorStorageBuffers < kBindings) {
        return "the device binds too few storage buffers";
    }
    return {};
}

JpegPipelines::JpegPipelines(DeviceResources& shared)
    : device_(shared.device), set_layout_(storageLayout(device_, kBindings)),
      layout_(gpu::makePipelineLayout(device_, {*set_layout_}, sizeof(io::JpegPicture))),
      made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

vk::Pipeline JpegPipelines::pipeline(JpegPass pass, const JpegFormat& format) {
    const auto transform = format.transform;
    const uint32_t sampling = format.luma_sampling;
    return *made_.findOrMake(std::tuple(pass, sampling, transform), [=, this] {
        const uint32_t fast = transform == JpegTransform::kFast ? 1 : 0;
        return gpu::makeComputePipeline(device_, codeOf(pass), {sampling, fast}, *layout_,
                                        pass::kJpegBlocks);
    });
}

JpegScratch::JpegScratch(const gpu::Device& device, const JpegSizes& sizes) : arena_(device) {
    const auto make = [&](vk::DeviceSize bytes) {
        return arena_.makeBuffer(bytes, vk::BufferUsageFlagBits::eStorageBuffer,
                                 gpu::MemoryUse::kDevice, "jpeg codes");
    };
    runs_ = make(sizes.run_bytes);
    places_ = make(sizes.place_bytes);
    codes_ = make(sizes.code_bytes);
}

JpegSet::JpegSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
    : set_(device, layout, kBindings) {}

void JpegSet::write(const gpu::Buffer& pixels,
                    vk::Buffer upload,
                    vk::DeviceSize tables,
                    const JpegScratch& scratch,
                    const gpu::Buffer& file) {
    const std::array<vk::DescriptorBufferInfo, kBindings> buffers = {{
        {*pixels.handle, 0, VK_WHOLE_SIZE},
        {upload, tables, sizeof(JpegTablePair)},
        {*scratch.runs().handle, 0, VK_WHOLE_SIZE},
        {*scratch.places().handle, 0, VK_WHOLE_SIZE},
        {*scratch.codes().handle, 0, VK_WHOLE_SIZE},
        {*file.handle, 0, VK_WHOLE_SIZE},
    }};
    set_.write(buffers);
}

void recordJpeg(const vk::raii::CommandBuffer& cmd,
                gpu::Timestamps& timestamps,
                JpegPipelines& pipelines,
                const JpegFormat& format,
                const JpegSizes& sizes,
                const JpegSet& set) {
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0, set.handle(),
                           {});
    cmd.pushConstants<io::JpegPicture>(pipelines.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                       sizes.picture);
    const auto record = [&](JpegPass pass, const char* name, uint32_t groups) {
        const gpu::PassScope scope(timestamps, cmd, name);
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines.pipeline(pass, format));
        cmd.dispatch(groups, 1, 1);
    };
    const uint32_t runs = sizes.picture.run_count;
    record(JpegPass::kBlocks, pass::kJpegBlocks, runs);
    nextComputePass(cmd);
    record(JpegPass::kPlace, pass::kJpegPlace, 1);
    nextComputePass(cmd);
    record(JpegPass::kStuff, pass::kJpegStuff, runs);
}

} // namespace froxel::render
