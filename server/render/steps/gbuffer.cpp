// The G-buffer: solid surfaces' materials, by the rasteriser or from the ids of their triangles.
#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/counting_step.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_passes.h"

#include <array>
#include <string>

namespace froxel::render {

namespace {

using LoadOp = vk::AttachmentLoadOp;

class Gbuffer final : public CountingStep {
  public:
    using CountingStep::CountingStep;

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({by_ids_ ? pass::kResolve : pass::kGbuffer,
                          timeOver(cost(costs), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        restart(frame);
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    by_ids_ ? recordVisibilityGbuffer(at, part) : recordRaster(at, part);
                });
    }

  private:
    Result<void> build(const StepInputs& /*inputs*/, const FramePlan& frame) override {
        by_ids_ = frame.byIds();
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        return by_ids_ ? costs.resolved(false) : costs.surfaces();
    }
    void recordRaster(const FrameContext& frame, const vk::Rect2D& part) const;

    bool by_ids_ = false;
};

void Gbuffer::recordRaster(const FrameContext& frame, const vk::Rect2D& part) const {
    const auto pass = afterDepth() ? GeometryPass::kGbufferAfterDepth : GeometryPass::kGbuffer;
    inGroups(frame, pass, frame.draws.solid, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kGbuffer);
        const Samples samples(frame, counts());
        // Words of empty pixels are never read: their depth says so.
        std::vector colors = {
            attachment(frame.slot.targets->gbuffer, first ? LoadOp::eDontCare : LoadOp::eLoad)};
        if (*frame.slot.targets->gbuffer_extra.handle) {
            // A stored depth of 0 is an empty pixel.
            colors.push_back(attachment(frame.slot.targets->gbuffer_extra,
                                        first ? LoadOp::eClear : LoadOp::eLoad,
                                        vk::ClearColorValue(std::array<uint32_t, 4>{})));
        }
        const auto depth =
            attachment(frame.slot.targets->depth,
                       first && !afterDepth() ? LoadOp::eClear : LoadOp::eLoad, farDepth());
        const Rendering rendering(frame, part, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

std::optional<StepPlan> planOfGbuffer(const PlanInputs& inputs) {
    const FramePlan& frame = inputs.plan;
    if (frame.solid != Solid::kDeferred && frame.solid != Solid::kShownGbuffer) {
        return {};
    }
    return StepPlan{.way = countingWay(frame, frame.find(kDepthStep) != nullptr)};
}

std::vector<Use> usesOfGbuffer(const FramePlan& frame, const StepPlan& /*plan*/) {
    if (frame.byIds()) { // which also stores the depth of ids that compute rastered
        return {use::loaded(Resource::kPosed),
                use::sampled(Resource::kIds),
                {Resource::kDepth, use::Stage::eComputeShader,
                 use::Access::eShaderSampledRead | use::Access::eShaderStorageWrite},
                use::stored(Resource::kGbuffer)};
    }
    return {use::vertices(), use::depthTested(), use::drawn(Resource::kGbuffer)};
}

std::string wordsOfGbuffer(const PlanInputs& inputs, const StepPlan* plan) {
    if (inputs.plan.solid == Solid::kFragments) {
        return {};
    }
    if (plan == nullptr) {
        return inputs.plan.solid == Solid::kForward ? "no G-buffer: surfaces are shaded at once"
                                                    : "no G-buffer: depth alone";
    }
    const bool wide = (inputs.plan.gbuffer_output_flags & io::kOutputWideGbuffer) != 0;
    const bool specular = (inputs.plan.gbuffer_output_flags & io::kOutputSpecular) != 0;
    return (wide ? "metalness, occlusion, emission or unlit surfaces: G-buffer of "
                 : "no metalness, occlusion, emission or unlit: G-buffer of ") +
           std::to_string(gbufferBytesPerPixel(inputs.settings.gbuffer, wide, specular)) +
           " bytes a pixel";
}

} // namespace

const StepRow kGbufferStep{.name = pass::kGbuffer,
                           .plan = planOfGbuffer,
                           .uses = usesOfGbuffer,
                           .words = wordsOfGbuffer,
                           .make = makeStep<Gbuffer>};

} // namespace froxel::render
