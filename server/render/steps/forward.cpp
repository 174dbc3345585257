// Forward: solid surfaces, shaded as the rasteriser draws them or, in compute, from the ids of
// their triangles.
#include "interface/constants.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/surfaces/counting_step.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_passes.h"

#include <algorithm>
#include <array>

namespace froxel::render {

namespace {

using LoadOp = vk::AttachmentLoadOp;

class Forward final : public CountingStep {
  public:
    using CountingStep::CountingStep;

    void addLoad(const UnitCosts& /*unit*/, CostInputs& load) const override {
        load.lit_surfaces = std::max(load.lit_surfaces, litSurfaces(material_flags_));
    }
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({by_ids_ ? pass::kShade : pass::kForward,
                          timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return costs.shadedLoop(by_ids_ ? costs.unit().compute : costs.unit().fragment);
    }
    void record(const FrameContext& frame) const override {
        restart(frame);
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    by_ids_ ? recordVisibilityShade(at, part, packingFlags(at.plan, plan()))
                            : recordRaster(at, part);
                });
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override {
        by_ids_ = frame.byIds();
        material_flags_ = shadedById(inputs, frame);
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        // Behind a prepass each pixel is shaded once.
        return by_ids_ ? costs.resolved(true)
                       : costs.shadedSurfaces(afterDepth() ? 1.0 : costs.load().overdraw);
    }
    void recordRaster(const FrameContext& frame, const vk::Rect2D& part) const;

    bool by_ids_ = false;
    MaterialFlags material_flags_ = 0; // shadedById()
};

void Forward::recordRaster(const FrameContext& frame, const vk::Rect2D& part) const {
    const auto pass = afterDepth() ? GeometryPass::kForwardAfterDepth : GeometryPass::kForward;
    inGroups(frame, pass, frame.draws.solid, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kForward);
        const Samples samples(frame, counts());
        const std::array colors = {attachment(frame.slot.targets->radiance,
                                              first ? LoadOp::eClear : LoadOp::eLoad, nothing())};
        const auto depth =
            attachment(frame.slot.targets->depth,
                       first && !afterDepth() ? LoadOp::eClear : LoadOp::eLoad, farDepth());
        const Rendering rendering(frame, part, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

std::optional<StepPlan> planOfForward(const PlanInputs& inputs) {
    const FramePlan& frame = inputs.plan;
    if (frame.solid != Solid::kForward) {
        return {};
    }
    return StepPlan{.way = countingWay(frame, frame.find(kDepthStep) != nullptr),
                    .can_pack = frame.byIds() && canPack(inputs.settings)};
}

std::vector<Use> usesOfForward(const FramePlan& frame, const StepPlan& plan) {
    if (!frame.byIds()) {
        return withLights({use::vertices(), use::depthTested(), use::drawn(Resource::kRadiance)},
                          use::Stage::eFragmentShader);
    }
    return withPacking(
        withLights({use::loaded(Resource::kPosed),
                    use::sampled(Resource::kIds),
                    {Resource::kDepth, use::Stage::eComputeShader,
                     use::Access::eShaderSampledRead | use::Access::eShaderStorageWrite}},
                   use::Stage::eComputeShader),
        plan);
}

} // namespace

const StepRow kForwardStep{.name = pass::kForward,
                           .part = StepPart::kPicture,
                           .plan = planOfForward,
                           .uses = usesOfForward,
                           .make = makeStep<Forward>};

} // namespace froxel::render
