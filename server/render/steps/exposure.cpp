// The exposure, metered by this frame's own luminance before anything is blended.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/exposure_io.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/pipelines/storage_set.h"
#include "render/steps/order.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

// Stops besides the exposure that was asked for.
constexpr std::array kMetered = {
    StatRow{.group = "", .name = "metered_ev", .field = "metered_ev", .whole = false}};

constexpr vk::DeviceSize kCountBytes = io::kMeterBins * sizeof(uint32_t);

// Shared by every view.
struct ExposurePipelines {
    explicit ExposurePipelines(const DeviceResources& shared)
        : set_layout(storageLayout(shared.device, 2)),
          layout(gpu::makePipelineLayout(
              shared.device,
              {shared.pipelines.frameLayout(), shared.pipelines.screenLayout(), *set_layout})),
          histogram(gpu::makeComputePipeline(shared.device,
                                             shaders::exposure_histogram_comp(),
                                             {},
                                             *layout,
                                             "exposure histogram")),
          meter(gpu::makeComputePipeline(
              shared.device, shaders::exposure_meter_comp(), {}, *layout, "exposure meter")) {}

    vk::raii::DescriptorSetLayout set_layout;
    vk::raii::PipelineLayout layout;
    SharedPipeline histogram;
    SharedPipeline meter;
};

// One view's histogram.
struct ExposureTargets final : StepTargets {
    explicit ExposureTargets(const gpu::Device& device)
        : arena(device), counts(arena.makeBuffer(kCountBytes,
                                                 vk::BufferUsageFlagBits::eStorageBuffer |
                                                     vk::BufferUsageFlagBits::eTransferDst,
                                                 gpu::MemoryUse::kDevice,
                                                 "exposure histogram")) {}

    gpu::MemoryArena arena;
    gpu::Buffer counts;
};

// One a frame slot.
struct ExposureSet {
    ExposureSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : set(device, layout, 2) {}

    // `uniforms`: io::Frame in the slot's upload.
    void write(const gpu::Buffer& counts, vk::Buffer upload, const FrameBlock& uniforms) {
        exposure_offset = uniforms.offset + offsetof(io::Frame, exposure);
        set.write(std::array{vk::DescriptorBufferInfo{*counts.handle, 0, VK_WHOLE_SIZE},
                             vk::DescriptorBufferInfo{upload, uniforms.offset, uniforms.bytes}});
    }

    StorageSet set;
    vk::DeviceSize exposure_offset = 0;
};

class Exposure final : public Step {
  public:
    explicit Exposure(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        const auto& drawn = costs.load().size.drawn;
        passes.push_back({pass::kExposure, timeOver(countingCost(costs), invocationsOver(drawn))});
    }
    void addMemory(NeedList& need) const override {
        need.buffer("exposure histogram", kCountBytes);
    }

    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;

    void record(const FrameContext& frame) const override;
    void addResults(const FrameSlot& slot, const StepPlan& its, FrameStats& stats) const override;

  private:
    // Of the histogram's pass.
    static settings::Size invocationsOver(const settings::Size& drawn) {
        const auto over = [](uint32_t side_px) {
            return (side_px + io::kMeterPixels - 1) / io::kMeterPixels;
        };
        return {over(drawn.width_px), over(drawn.height_px)};
    }
    // Over its invocations.
    static RegionCost countingCost(const FrameCosts& costs) {
        const double each = io::kMeterPixels * io::kMeterPixels * costs.unit().screen_pixel;
        return {Seconds(0),
                [each](const vk::Rect2D& region) { return Seconds(areaOf(region) * each); }};
    }
    static void bind(const FrameContext& frame, SharedPipeline& pipeline);
    static void recordHistogram(const FrameContext& frame, const vk::Rect2D& invocations);
    static void recordMeter(const FrameContext& frame);

    SceneResources& scene_;
    std::shared_ptr<ExposureTargets> targets_; // null: the last frame has none
};

void Exposure::prepare(FrameSlot& slot, FrameBlocks& blocks) {
    if (!targets_) {
        targets_ = std::make_shared<ExposureTargets>(scene_.shared.device);
    }
    slot.step_targets.hold(targets_);
    const auto& shared = scene_.shared.stored<ExposurePipelines>();
    slot.stored.findOrMake<ExposureSet>(scene_.shared.device, *shared.set_layout)
        .write(targets_->counts, slot.upload.buffer(), blocks[io::kFrameBinding]);
}

void Exposure::record(const FrameContext& frame) const {
    const auto& cmd = frame.slot.cmd;
    cmd.fillBuffer(*targets_->counts.handle, 0, VK_WHOLE_SIZE, 0);
    computeAfterTransfer(cmd);
    inParts(frame, invocationsOver(frame.drawn()), countingCost(frame.costs), recordHistogram);
    nextComputePass(cmd); // counts
    recordMeter(frame);
    // the exposure -> the uniforms of all stages, and what else is in their buffer
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eAllCommands,
            Access::eMemoryRead);
}

void Exposure::addResults(const FrameSlot& slot, const StepPlan& /*its*/, FrameStats& stats) const {
    float exposure = 0;
    std::memcpy(&exposure, slot.upload.mapped() + slot.stored.get<ExposureSet>().exposure_offset,
                sizeof(exposure));
    stats.steps.set(kMetered[0], std::log2(static_cast<double>(exposure) /
                                           static_cast<double>(slot.inputs.settings.exposure)));
}

void Exposure::bind(const FrameContext& frame, SharedPipeline& pipeline) {
    const auto& cmd = frame.slot.cmd;
    pipeline.bind(cmd, frame.scene.shared.variants);
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                             frame.slot.stored.get<ExposureSet>().set.handle()};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute,
                           *frame.scene.shared.stored<ExposurePipelines>().layout, 0, sets, {});
}

void Exposure::recordHistogram(const FrameContext& frame, const vk::Rect2D& invocations) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kExposure);
    bind(frame, frame.scene.shared.stored<ExposurePipelines>().histogram);
    dispatchOver(frame.slot.cmd, invocations);
}

// Reads the counts, changes the frame's exposure.
void Exposure::recordMeter(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kExposureMeter);
    bind(frame, frame.scene.shared.stored<ExposurePipelines>().meter);
    frame.slot.cmd.dispatch(1, 1, 1);
}

std::optional<StepPlan> planOfExposure(const PlanInputs& inputs) {
    return inputs.settings.exposure_mode == settings::ExposureMode::kFrame
               ? std::optional(StepPlan{})
               : std::nullopt;
}

} // namespace

const StepRow kExposureStep{
    .name = pass::kExposure,
    .part = StepPart::kPicture,
    .plan = planOfExposure,
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kDepth), use::loaded(Resource::kRadiance)};
        },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr ? "exposure of this frame: a separate pass measures "
                                                 "a histogram of its luminance"
                                               : "");
        },
    .make = makeStep<Exposure>,
    .stats = kMetered};

} // namespace froxel::render
