#include "gpu/pipeline.h"

#include <array>

namespace froxel::gpu {

namespace {

vk::raii::ShaderModule makeModule(const Device& device, Spirv code) {
    return device.handle().createShaderModule(
        {.codeSize = code.size_bytes(), .pCode = code.data()});
}

// Vulkan's view of a SpecConstants; both must outlive the pipeline's creation.
struct SpecInfo {
    explicit SpecInfo(const SpecConstants& constants) {
        for (uint32_t i = 0; i < constants.size(); ++i) {
            const auto offset = static_cast<uint32_t>(i * sizeof(uint32_t));
            entries.push_back({.constantID = i, .offset = offset, .size = sizeof(uint32_t)});
        }
        info = vk::SpecializationInfo{.mapEntryCount = static_cast<uint32_t>(entries.size()),
                                      .pMapEntries = entries.data(),
                                      .dataSize = constants.size() * sizeof(uint32_t),
                                      .pData = constants.data()};
    }
    SpecInfo(const SpecInfo&) = delete;
    SpecInfo& operator=(const SpecInfo&) = delete;

    std::vector<vk::SpecializationMapEntry> entries;
    vk::SpecializationInfo info;
};

vk::PipelineColorBlendAttachmentState attachmentState(Blend blend) {
    using Component = vk::ColorComponentFlagBits;
    using Factor = vk::BlendFactor;
    constexpr auto kAll = Component::eR | Component::eG | Component::eB | Component::eA;
    if (blend == Blend::kDim) {
        return {.blendEnable = VK_TRUE,
                .srcColorBlendFactor = Factor::eZero,
                .dstColorBlendFactor = Factor::eSrcColor,
                .colorBlendOp = vk::BlendOp::eAdd,
                .srcAlphaBlendFactor = Factor::eOne,
                .dstAlphaBlendFactor = Factor::eOne,
                .alphaBlendOp = vk::BlendOp::eMax,
                .colorWriteMask = kAll};
    }
    const bool over = blend == Blend::kNone || blend == Blend::kOver;
    const bool weighted = blend == Blend::kWeighted;
    const Factor taken = blend == Blend::kUnder ? Factor::eOneMinusDstAlpha : Factor::eOne;
    const Factor kept = over ? Factor::eOneMinusSrcAlpha : Factor::eOne;
    return {.blendEnable = blend != Blend::kNone,
            .srcColorBlendFactor = taken,
            .dstColorBlendFactor = kept,
            .colorBlendOp = vk::BlendOp::eAdd,
            .srcAlphaBlendFactor = weighted ? Factor::eZero : taken,
            .dstAlphaBlendFactor = weighted ? Factor::eOneMinusSrcAlpha : kept,
            .alphaBlendOp = vk::BlendOp::eAdd,
            .colorWriteMask = kAll};
}

vk::PipelineDepthStencilStateCreateInfo depthState(const GraphicsPipelineInfo& info) {
    const bool depth = info.depth_format != vk::Format::eUndefined;
    return {.depthTestEnable = depth,
            .depthWriteEnable = depth && info.depth_write,
            .depthCompareOp = info.depth_compare};
}

} // namespace

vk::raii::Pipeline makeGraphicsPipeline(const Device& device,
                                        const GraphicsPipelineInfo& info,
                                        std::string_view name) {
    const auto vertex = makeModule(device, info.vertex);
    const auto fragment =
        info.fragment.empty() ? vk::raii::ShaderModule(nullptr) : makeModule(device, info.fragment);
    const SpecInfo spec(info.constants);
    std::vector<vk::PipelineShaderStageCreateInfo> stages = {
        {.stage = vk::ShaderStageFlagBits::eVertex,
         .module = *vertex,
         .pName = "main",
         .pSpecializationInfo = &spec.info}};
    if (*fragment) {
        stages.push_back({.stage = vk::ShaderStageFlagBits::eFragment,
                          .module = *fragment,
                          .pName = "main",
                          .pSpecializationInfo = &spec.info});
    }
    const vk::PipelineVertexInputStateCreateInfo input{
        .vertexBindingDescriptionCount = static_cast<uint32_t>(info.bindings.size()),
        .pVertexBindingDescriptions = info.bindings.data(),
        .vertexAttributeDescriptionCount = static_cast<uint32_t>(info.attributes.size()),
        .pVertexAttributeDescriptions = info.attributes.data()};
    const vk::PipelineInputAssemblyStateCreateInfo assembly{
        .topology =
            info.lines ? vk::PrimitiveTopology::eLineList : vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1.0F};
    const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples =
                                                             vk::SampleCountFlagBits::e1};
    const auto depth_state = depthState(info);
    const std::vector blends(info.color_formats.size(), attachmentState(info.blend));
    const vk::PipelineColorBlendStateCreateInfo blend{
        .attachmentCount = static_cast<uint32_t>(blends.size()), .pAttachments = blends.data()};
    const std::array dynamics = {vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                 vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount =
                                                         static_cast<uint32_t>(dynamics.size()),
                                                     .pDynamicStates = dynamics.data()};
    const vk::PipelineRenderingCreateInfo rendering{
        .colorAttachmentCount = static_cast<uint32_t>(info.color_formats.size()),
        .pColorAttachmentFormats = info.color_formats.data(),
        .depthAttachmentFormat = info.depth_format};
    auto pipeline = device.handle().createGraphicsPipeline(
        device.pipelineCache(),
        vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                       .stageCount = static_cast<uint32_t>(stages.size()),
                                       .pStages = stages.data(),
                                       .pVertexInputState = &input,
                                       .pInputAssemblyState = &assembly,
                                       .pViewportState = &viewport,
                                       .pRasterizationState = &raster,
                                       .pMultisampleState = &samples,
                                       .pDepthStencilState = &depth_state,
                                       .pColorBlendState = &blend,
                                       .pDynamicState = &dynamic,
                                       .layout = info.layout});
    device.setName(*pipeline, name);
    return pipeline;
}

vk::raii::Pipeline makeComputePipeline(const Device& device,
                                       Spirv code,
                                       const SpecConstants& constants,
                                       vk::PipelineLayout layout,
                                       std::string_view name) {
    const auto module = makeModule(device, code);
    const SpecInfo spec(constants);
    auto pipeline = device.handle().createComputePipeline(
        device.pipelineCache(),
        vk::ComputePipelineCreateInfo{// so that a part of a picture can be dispatched
                                      .flags = vk::PipelineCreateFlagBits::eDispatchBase,
                                      .stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                .module = *module,
                                                .pName = "main",
                                                .pSpecializationInfo = &spec.info},
                                      .layout = layout});
    device.setName(*pipeline, name);
    return pipeline;
}

vk::raii::DescriptorSetLayout
makeSetLayout(const Device& device, std::span<const vk::DescriptorSetLayoutBinding> bindings) {
    return device.handle().createDescriptorSetLayout(
        {.bindingCount = static_cast<uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool makeDescriptorPool(const Device& device,
                                            std::span<const vk::DescriptorPoolSize> sizes,
                                            uint32_t max_sets) {
    return device.handle().createDescriptorPool(
        {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
         .maxSets = max_sets,
         .poolSizeCount = static_cast<uint32_t>(sizes.size()),
         .pPoolSizes = sizes.data()});
}

vk::raii::DescriptorSet makeSet(const Device& device,
                                const vk::raii::DescriptorPool& pool,
                                vk::DescriptorSetLayout layout) {
    return std::move(device.handle().allocateDescriptorSets(
        {.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &layout})[0]);
}

vk::raii::PipelineLayout makePipelineLayout(const Device& device,
                                            std::initializer_list<vk::DescriptorSetLayout> sets,
                                            uint32_t push_bytes,
                                            vk::ShaderStageFlags push_stages) {
    const vk::PushConstantRange range{push_stages, 0, push_bytes};
    return device.handle().createPipelineLayout(
        {.setLayoutCount = static_cast<uint32_t>(sets.size()),
         .pSetLayouts = sets.begin(),
         .pushConstantRangeCount = push_bytes > 0 ? 1U : 0U,
         .pPushConstantRanges = &range});
}

} // namespace froxel::gpu
