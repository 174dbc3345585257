// Which surfaces that transmit light a pixel sees, the nearest first: several layers, by the
// rasteriser the depth of one after another, or in compute the ids and depths of all at once.
#include "interface/constants.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/scene/visibility_scene.h"
#include "render/steps/order.h"
#include "render/steps/transmission_targets.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/raster_passes.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_binding.h"

#include <algorithm>
#include <array>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using LoadOp = vk::AttachmentLoadOp;
using Stage = vk::PipelineStageFlagBits2;

class TransmissionDepth final : public Step {
  public:
    explicit TransmissionDepth(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back(
            {pass::kTransmissionDepth, shape_.by_ids ? idsCost(costs) : depthsCost(costs)});
    }
    void addMemory(NeedList& need) const override {
        const TransmissionImages images = transmissionImages(drawn_, shape_);
        need.image("picture behind", images.behind);
        for (uint32_t layer = 0; layer < images.layer_depth_count; ++layer) {
            need.image("transmissive layer depth", images.layer_depth);
        }
        need.buffer("words of transmissive layers", layerWordBytes(drawn_, shape_));
        need.buffer("tiles of transmissive layers", layerTileBytes(drawn_, shape_));
    }

    void freeUnfit(const ViewTargets* view) override {
        if (targets_ && (view == nullptr || !targets_->fits(shape_, *view))) {
            targets_.reset();
        }
    }
    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;
    void record(const FrameContext& frame) const override {
        if (shape_.by_ids) {
            recordIds(frame);
            return;
        }
        for (uint32_t layer = 0; layer < shape_.layer_count; ++layer) {
            if (layer > 0) {
                nextRasterPass(frame.slot.cmd);
            }
            const vk::Rect2D region = clearedBy(layer);
            inParts(frame, frame.drawn(), within(frame.costs.depth(), region),
                    [layer, region](const FrameContext& at, const vk::Rect2D& part) {
                        recordPart(at, common(part, region), layer);
                    });
        }
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        drawn_ = inputs.size.drawn;
        shape_ = transmissionShape(scene_, inputs, plan());
        covered_ = around(inputs.draws.transmissive.parts);
        visible_ = layersById(scene_, inputs, plan());

        return {};
    }
    // Blended surfaces anywhere ask where the nearest layer is.
    [[nodiscard]] vk::Rect2D clearedBy(uint32_t layer) const {
        const bool everywhere = layer == 0 && plan().blended_output_flags != 0;
        return everywhere ? vk::Rect2D{{0, 0}, {drawn_.width_px, drawn_.height_px}} : covered_;
    }
    [[nodiscard]] Seconds depthsCost(const FrameCosts& costs) const {
        Seconds sum{0};
        for (uint32_t layer = 0; layer < shape_.layer_count; ++layer) {
            sum += timeOver(within(costs.depth(), clearedBy(layer)), drawn_);
        }
        return sum;
    }
    [[nodiscard]] Seconds idsCost(const FrameCosts& costs) const {
        RegionCost cost = within(costs.depth(), covered_);

        cost.each = Seconds(visible_->triangle_count * costs.unit().triangle);
        return timeOver(cost, drawn_);
    }

    void recordIds(const FrameContext& frame) const;
    void recordHeads(const FrameContext& frame) const;
    void recordClear(const FrameContext& frame) const;
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) {
        if (part.extent.width == 0) {
            return;
        }
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransmissionDepth);
        const auto& targets = transmissionTargets(frame);
        const auto depth = attachment(targets.layer_depths[layer], LoadOp::eClear, farDepth());
        const Rendering rendering(frame, part, {}, &depth);
        bindTransmission(frame, targets.depthSet(layer));
        drawGroups(frame, GeometryPass::kTransmissionDepth, frame.draws.transmissive.groups, layer);
    }

    SceneResources& scene_;
    settings::Size drawn_;
    TransmissionShape shape_;
    vk::Rect2D covered_;                           // by surfaces
    VisibilityScene* visible_ = nullptr;           // by ids: of the frame's materials
    std::shared_ptr<TransmissionTargets> targets_; // null: the last frame has none
};

void TransmissionDepth::prepare(FrameSlot& slot, FrameBlocks& blocks) {
    if (targets_ && !targets_->fits(shape_, *slot.targets)) {
        targets_.reset(); // before its successor takes memory
    }
    if (!targets_) {
        targets_ = std::make_shared<TransmissionTargets>(scene_.shared, shape_, slot.targets);
    }
    slot.step_targets.hold(targets_);
    const vk::ImageView nearest =
        targets_->layer_depths.empty() ? vk::ImageView{} : *targets_->layer_depths.front().view;
    blocks[io::kTransmissiveDepthBinding].image = nearest;
    if (!shape_.by_ids) {
        return;
    }
    auto bindings = visibilityBindings(scene_, *visible_, slot);
    bindings.raster = &visible_->computeRaster();
    bindings.words = *targets_->words.handle;
    bindings.tiles = *targets_->tiles.handle;
    if (nearest) {
        bindings.depth = nearest;
    }
    slot.stored.findOrMake<TransmissiveFrame>(scene_.shared.device, *visible_).write(bindings);
}

// No tile of any layer.
std::array<uint32_t, io::kTileHeadWords> emptyTileHeads() {
    std::array<uint32_t, io::kTileHeadWords> words;
    for (size_t i = 0; i < words.size(); ++i) {
        words[i] = i % 4 == 0 ? 0 : 1;
    }
    return words;
}

void TransmissionDepth::recordHeads(const FrameContext& frame) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransmissionDepth);
    const ComputeRaster& raster = visible_->computeRaster();
    io::RasterBatch batch = raster.empty_batches.front();
    batch.layer_count = shape_.layer_count;
    frame.slot.cmd.updateBuffer<io::RasterBatch>(*raster.batches.handle, 0, batch);
    frame.slot.cmd.updateBuffer<uint32_t>(*targets_->tiles.handle, 0, emptyTileHeads());
}

// Words of all rows of workgroups that surfaces cover.
void TransmissionDepth::recordClear(const FrameContext& frame) const {
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kTransmissionDepth);
    const auto first = static_cast<uint32_t>(covered_.offset.y);
    const uint32_t end =
        std::min(first + screenGroups(covered_.extent.height) * io::kScreenGroup, drawn_.height_px);
    const vk::DeviceSize row = kWordBytes * drawn_.width_px;
    for (uint32_t layer = 0; end > first && layer < shape_.layer_count; ++layer) {
        const uint32_t before = layer * drawn_.height_px;
        cmd.fillBuffer(*targets_->words.handle, (before + first) * row, (end - first) * row, 0);
    }
}

void TransmissionDepth::recordIds(const FrameContext& frame) const {
    FrameContext of_layers = frame;
    of_layers.visibility = visible_;
    const auto& cmd = frame.slot.cmd;
    frame.pieces.add(idsCost(frame.costs));
    recordHeads(frame);
    computeAfterTransfer(cmd);
    recordClear(frame); // while meshlets are culled
    recordRasterCull(of_layers, (plan().way & kCullsLayers) != 0);
    computeAfterTransfer(cmd);
    nextIndirectPass(cmd);
    recordRasterMeshlets(of_layers, 0);
    nextComputePass(cmd);
    recordRasterBlocks(of_layers, 0);
    nextComputePass(cmd);
    shape_.nearest_depth ? recordLayerTilesAndDepth(of_layers, covered_)
                         : recordLayerTiles(of_layers, covered_);
}

std::optional<StepPlan> planOfDepth(const PlanInputs& inputs) {
    auto plan = planOfTransmission(inputs);
    if (plan && inputs.facts.transparent_visible) {
        plan->blended_output_flags = io::kOutputBeforeTransmissive;
    }
    return plan;
}

std::vector<Use> usesOfDepth(const FramePlan& /*frame*/, const StepPlan& plan) {
    if ((plan.way & kLayersByIds) != 0) {
        return {use::loaded(Resource::kPosed),
                use::sampled(Resource::kDepth),
                {Resource::kTransmissiveDepth, Stage::eAllTransfer | Stage::eComputeShader,
                 Access::eTransferWrite | use::kLoadStore}};
    }
    return {use::vertices(),
            use::sampled(Resource::kDepth, Stage::eFragmentShader),
            {Resource::kTransmissiveDepth, kDepthStages,
             Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite}};
}

} // namespace

const StepRow kTransmissionDepthStep{.name = pass::kTransmissionDepth,
                                     .part = StepPart::kPicture,
                                     .plan = planOfDepth,
                                     .uses = usesOfDepth,
                                     .make = makeStep<TransmissionDepth>};

} // namespace froxel::render
