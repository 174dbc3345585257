// What the host reads of a frame: packed pixels, where it does not read what the device writes, and
// outputs that were asked for.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/pipelines/storage_set.h"
#include "render/steps/order.h"

#include <array>

namespace froxel::render {

namespace {

// Of an output: at a bus's 16 GB/s; about a CPU's memory, too.
RegionCost copyCost(Output output) {
    constexpr double kBytesASecond = 16e9;
    const double each =
        kOutputRows[static_cast<size_t>(output)].floats * sizeof(float) / kBytesASecond;
    return {Seconds(0), [each](const auto& region) { return Seconds(areaOf(region) * each); }};
}

class PixelReadback final : public Step {
  public:
    explicit PixelReadback(SceneResources& scene) : scene_(scene) {}

    // Beside the frame it takes nothing of the device's time.
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        if (!scene_.shared.copies) {
            passes.push_back({pass::kReadback, timeOf(costs)});
        }
    }
    void record(const FrameContext& frame) const override {
        const auto& pixels = frame.slot.targets->pixels;
        if (frame.slot.host_copy.isBeside()) {
            frame.slot.host_copy.record(pixels, frame.slot.readback->buffer);
            return;
        }
        frame.pieces.add(timeOf(frame.costs));
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kReadback);
        frame.slot.cmd.copyBuffer(*pixels.handle, *frame.slot.readback->buffer.handle,
                                  vk::BufferCopy{.size = pixels.size_bytes});
    }

  private:
    static Seconds timeOf(const FrameCosts& costs) {
        const auto& size = costs.load().size.shown;
        return Seconds(static_cast<double>(size.width_px) * size.height_px *
                       costs.unit().copied_pixel);
    }

    SceneResources& scene_;
};

class RadianceReadback final : public Step {
  public:
    explicit RadianceReadback(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kRadianceReadback, timeOver(cost(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(), recordPart);
    }

  private:
    static RegionCost cost() { return copyCost(Output::kRadiance); }
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRadianceReadback);
        const uint32_t row_px = frame.drawn().width_px;
        const auto x = static_cast<vk::DeviceSize>(part.offset.x);
        const auto y = static_cast<vk::DeviceSize>(part.offset.y);
        frame.slot.cmd.copyImageToBuffer(
            *frame.slot.targets->radiance.handle, vk::ImageLayout::eGeneral,
            *frame.slot.readback->output(Output::kRadiance).handle,
            vk::BufferImageCopy{.bufferOffset = (y * row_px + x) * 4 * sizeof(float),
                                .bufferRowLength = row_px,
                                .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                .imageOffset = {part.offset.x, part.offset.y, 0},
                                .imageExtent = {part.extent.width, part.extent.height, 1}});
    }
};

// Shared by every view.
struct LinearDepthPipeline {
    explicit LinearDepthPipeline(const DeviceResources& shared)
        : set_layout(storageLayout(shared.device, 1)),
          layout(gpu::makePipelineLayout(
              shared.device,
              {shared.pipelines.frameLayout(), shared.pipelines.screenLayout(), *set_layout})),
          pipeline(gpu::makeComputePipeline(
              shared.device, shaders::linear_depth_comp(), {}, *layout, pass::kLinearDepth)) {}

    vk::raii::DescriptorSetLayout set_layout;
    vk::raii::PipelineLayout layout;
    SharedPipeline pipeline;
};

// One a frame slot.
struct LinearDepthSet : StorageSet {
    LinearDepthSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : StorageSet(device, layout, 1) {}
};

// Writes where the host reads.
class LinearDepth final : public Step {
  public:
    explicit LinearDepth(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kLinearDepth, timeOver(cost(costs), costs.load().size.drawn)});
    }
    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        const auto& shared = scene_.shared.stored<LinearDepthPipeline>();
        const gpu::Buffer& depths = slot.readback->output(Output::kDepth);
        slot.stored.findOrMake<LinearDepthSet>(scene_.shared.device, *shared.set_layout)
            .write(std::array{vk::DescriptorBufferInfo{*depths.handle, 0, VK_WHOLE_SIZE}});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(frame.costs), recordPart);
    }

  private:
    static RegionCost cost(const FrameCosts& costs) {
        const RegionCost screen = costs.screen();
        const RegionCost copy = copyCost(Output::kDepth);
        return {Seconds(0),
                [screen, copy](const auto& region) { return screen.of(region) + copy.of(region); }};
    }
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const auto& cmd = frame.slot.cmd;
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kLinearDepth);
        auto& shared = frame.scene.shared.stored<LinearDepthPipeline>();
        shared.pipeline.bind(cmd, frame.scene.shared.variants);
        const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                                 frame.slot.stored.get<LinearDepthSet>().handle()};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *shared.layout, 0, sets, {});
        dispatchOver(cmd, part);
    }

    SceneResources& scene_;
};

} // namespace

const StepRow kReadbackStep{
    .name = pass::kReadback,
    .plan =
        [](const PlanInputs& inputs) {
            return !inputs.facts.software_device && inputs.facts.form == PictureForm::kPixels
                       ? std::optional(StepPlan{})
                       : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::copied(Resource::kPixels)}; },
    .make = makeStep<PixelReadback>};

const StepRow kRadianceReadbackStep{
    .name = pass::kRadianceReadback,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.outputs.has(Output::kRadiance) ? std::optional(StepPlan{})
                                                               : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::copied(Resource::kRadiance)}; },
    .make = makeStep<RadianceReadback>};

const StepRow kLinearDepthStep{
    .name = pass::kLinearDepth,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.outputs.has(Output::kDepth) ? std::optional(StepPlan{})
                                                            : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::sampled(Resource::kDepth)}; },
    .make = makeStep<LinearDepth>};

} // namespace froxel::render
