// Fast approximate antialiasing: edges of the finished picture, filtered.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/steps/order.h"

#include <array>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

vk::raii::DescriptorSetLayout makeFxaaSetLayout(const gpu::Device& device) {
    const auto stage = vk::ShaderStageFlagBits::eCompute;
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding{0, Type::eUniformTexelBuffer, 1, stage},
        vk::DescriptorSetLayoutBinding{1, Type::eStorageBuffer, 1, stage}};
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorPool makeFxaaPool(const gpu::Device& device) {
    const std::array sizes = {vk::DescriptorPoolSize{Type::eUniformTexelBuffer, 1},
                              vk::DescriptorPoolSize{Type::eStorageBuffer, 1}};
    return gpu::makeDescriptorPool(device, sizes);
}

// Shared by every view.
struct FxaaPipeline {
    explicit FxaaPipeline(const DeviceResources& shared)
        : set_layout(makeFxaaSetLayout(shared.device)),
          layout(gpu::makePipelineLayout(shared.device,
                                         {shared.pipelines.frameLayout(), *set_layout})),
          pipeline(
              gpu::makeComputePipeline(shared.device, shaders::fxaa_comp(), {}, *layout, "fxaa")) {}

    vk::raii::DescriptorSetLayout set_layout;
    vk::raii::PipelineLayout layout;
    SharedPipeline pipeline;
};

// One a frame slot.
struct FxaaSet {
    FxaaSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : pool(makeFxaaPool(device)), set(gpu::makeSet(device, pool, layout)) {}

    void write(const gpu::Device& device, const gpu::Buffer& display, const gpu::Buffer& pixels) {
        texels = device.handle().createBufferView({.buffer = *display.handle,
                                                   .format = vk::Format::eR32Uint,
                                                   .offset = 0,
                                                   .range = VK_WHOLE_SIZE});
        const vk::DescriptorBufferInfo buffer{*pixels.handle, 0, VK_WHOLE_SIZE};
        const std::array writes = {
            vk::WriteDescriptorSet{.dstSet = *set,
                                   .dstBinding = 0,
                                   .descriptorCount = 1,
                                   .descriptorType = Type::eUniformTexelBuffer,
                                   .pTexelBufferView = &*texels},
            vk::WriteDescriptorSet{.dstSet = *set,
                                   .dstBinding = 1,
                                   .descriptorCount = 1,
                                   .descriptorType = Type::eStorageBuffer,
                                   .pBufferInfo = &buffer}};
        device.handle().updateDescriptorSets(writes, {});
    }

    vk::raii::DescriptorPool pool;
    vk::raii::DescriptorSet set;
    vk::raii::BufferView texels{nullptr};
};

class Fxaa final : public Step {
  public:
    explicit Fxaa(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kFxaa, timeOver(costs.screen(), costs.load().size.shown)});
    }

    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        const auto& pipeline = scene_.shared.stored<FxaaPipeline>();
        slot.stored.findOrMake<FxaaSet>(scene_.shared.device, *pipeline.set_layout)
            .write(scene_.shared.device, packedPixels(slot, *plan().packed),
                   packedPixels(slot, *plan().packs));
    }

    void record(const FrameContext& frame) const override {
        inParts(frame, frame.shown(), frame.costs.screen(), recordPart);
    }

  private:
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const auto& cmd = frame.slot.cmd;
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kFxaa);
        auto& shared = frame.scene.shared.stored<FxaaPipeline>();
        shared.pipeline.bind(cmd, frame.scene.shared.variants);
        const std::array sets = {*frame.slot.frame_set, *frame.slot.stored.get<FxaaSet>().set};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *shared.layout, 0, sets, {});
        dispatchOver(cmd, part);
    }

    SceneResources& scene_;
};

std::optional<StepPlan> planOfFxaa(const PlanInputs& inputs) {
    return inputs.settings.antialiasing == settings::Antialiasing::kFxaa
               ? std::optional(StepPlan{.filters = true})
               : std::nullopt;
}

} // namespace

const StepRow kFxaaStep{
    .name = pass::kFxaa,
    .part = StepPart::kPicture,
    .plan = planOfFxaa,
    .uses =
        [](const FramePlan&, const StepPlan& plan) {
            return std::vector{use::sampled(plan.packed.value_or(Resource::kDisplay)),
                               use::stored(plan.packs.value_or(Resource::kPixels))};
        },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr
                                   ? "fxaa: a separate pass filters edges of the finished picture"
                                   : "");
        },
    .make = makeStep<Fxaa>};

} // namespace froxel::render
