// Ids of visible triangles and their depth, culled on the device, by the rasteriser or in compute.
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/scene/visibility_scene.h"
#include "render/steps/order.h"
#include "render/surfaces/raster_passes.h"
#include "render/surfaces/visibility_binding.h"
#include "render/surfaces/visibility_passes.h"

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

// Of StepPlan::way.
constexpr uint32_t kCullsMeshlets = 1U << 0U;

void recordComputeRaster(const FrameContext& frame, bool culls) {
    const auto& cmd = frame.slot.cmd;
    recordRasterClear(frame);
    computeAfterTransfer(cmd);
    recordRasterCull(frame, culls);
    nextIndirectPass(cmd);
    const uint32_t batch_count = rasterBatchCount(frame);
    for (uint32_t batch = 0; batch < batch_count; ++batch) {
        recordRasterMeshlets(frame, batch);
        nextComputePass(cmd);
        recordRasterBlocks(frame, batch);
        nextComputePass(cmd);
        if (batch + 1 < batch_count) {
            recordRasterFar(frame, batch);
            nextComputePass(cmd);
            recordRasterHidden(frame, batch + 1);
            nextIndirectPass(cmd);
        }
    }
    recordRasterUnpack(frame);
}

// By the rasteriser, of a part of the picture.
void recordVisiblePart(const FrameContext& frame, const vk::Rect2D& region, bool culls) {
    const auto& cmd = frame.slot.cmd;
    // draws of the part before -> this one's
    barrier(cmd, Stage::eDrawIndirect | Stage::eComputeShader, Access::eShaderStorageWrite,
            Stage::eComputeShader | Stage::eTransfer,
            Access::eShaderStorageWrite | Access::eTransferWrite);
    if (!frame.scene.shared.device.traits().draw_indirect_count) {
        recordEmptyDraws(frame);
        computeAfterTransfer(cmd);
    }
    recordCull(frame, culls);
    nextIndirectPass(cmd); // ranks and counts of visible meshlets
    recordCompact(frame);
    nextIndirectPass(cmd); // draws and their counts
    recordVisibility(frame, region);
}

class Ids final : public Step {
  public:
    explicit Ids(SceneResources& scene) : scene_(scene) {}

    void addLoad(const UnitCosts& /*unit*/, CostInputs& load) const override {
        load.resolve_count = visible_->pipelines.bindless()
                                 ? 1
                                 : static_cast<uint32_t>(visible_->materials_in_use.size());
    }
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kVisibility, timeOver(cost(costs), costs.load().size.drawn)});
    }
    // The host does not know what the device culls.
    void addStats(FrameStats& stats) const override {
        stats.triangle_count += visible_->triangle_count;
    }
    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override;
    void record(const FrameContext& frame) const override {
        const RegionCost of_ids = cost(frame.costs);
        const bool culls = (plan().way & kCullsMeshlets) != 0;
        if (in_compute_) {
            frame.pieces.add(timeOver(of_ids, frame.drawn()));
            recordComputeRaster(frame, culls);
            return;
        }
        // Views share the lists of visible meshlets: each part makes its own.
        inParts(frame, frame.drawn(), of_ids,
                [culls](const FrameContext& at, const vk::Rect2D& part) {
                    recordVisiblePart(at, part, culls);
                });
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override {
        in_compute_ = frame.geometry == SolidGeometry::kComputeIds;
        visible_ = &inputs.pose.materialSet()->visibility(
            scene_.detailOf(inputs.settings.geometry_error_px));
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        RegionCost of_ids = costs.depth();
        of_ids.each = Seconds(visible_->triangle_count * costs.unit().triangle);
        return of_ids;
    }

    SceneResources& scene_;
    bool in_compute_ = false;
    VisibilityScene* visible_ = nullptr; // of the frame's materials, which its slot holds
};

void Ids::prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) {
    auto& visible = *slot.visibility;
    const auto& targets = *slot.targets;
    auto bindings = visibilityBindings(scene_, visible, slot);
    bindings.draws = in_compute_ ? nullptr : &visible.culledDraws();
    if (visible.ordered()) {
        bindings.order = vk::DescriptorBufferInfo{slot.upload.buffer(), slot.offsets.meshlet_order,
                                                  visible.placed.size() * sizeof(uint32_t)};
    }
    if (targets.needs.gbuffer) {
        bindings.gbuffer = *targets.gbuffer.view;
    }
    bindings.raster = in_compute_ ? &visible.computeRaster() : nullptr;
    bindings.words = *targets.words.handle;
    slot.stored.findOrMake<VisibilityFrame>(scene_.shared.device, visible).write(bindings);
}

std::vector<Use> usesOfIds(const FramePlan& frame, const StepPlan& /*plan*/) {
    const Use posed{Resource::kPosed, Stage::eVertexAttributeInput | Stage::eComputeShader,
                    Access::eVertexAttributeRead | Access::eShaderStorageRead};
    if (frame.geometry == SolidGeometry::kComputeIds) {
        return {posed,
                use::stored(Resource::kDepth),
                use::stored(Resource::kIds),
                {Resource::kWords, Stage::eAllTransfer | Stage::eComputeShader,
                 Access::eTransferWrite | use::kLoadStore}};
    }
    return {posed, use::depthTested(), use::drawn(Resource::kIds)};
}

std::string wordsOfIds(const PlanInputs& inputs, const StepPlan* plan) {
    if (plan == nullptr) {
        return {};
    }
    const bool culls = (plan->way & kCullsMeshlets) != 0;
    return std::string("visibility: the device ") +
           (culls ? "culls meshlets and rasterises triangle ids" : "rasterises triangle ids") +
           (inputs.facts.geometry == SolidGeometry::kComputeIds ? " in compute" : "") +
           (culls ? "" : ", nothing culled");
}

} // namespace

const StepRow kIdsStep{
    .name = pass::kVisibility,
    .plan =
        [](const PlanInputs& inputs) {
            const uint32_t way = inputs.facts.cull_meshlets ? kCullsMeshlets : 0U;
            return inputs.plan.byIds() ? std::optional(StepPlan{.way = way}) : std::nullopt;
        },
    .uses = usesOfIds,
    .words = wordsOfIds,
    .make = makeStep<Ids>};

} // namespace froxel::render
