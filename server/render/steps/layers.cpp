// Surfaces with layers, for which the G-buffer has no room, shaded again over the lit picture.
#include "interface/constants.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_passes.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace froxel::render {

namespace {

class Layers final : public Step {
  public:
    explicit Layers(SceneResources& /*scene*/) {}

    void addLoad(const UnitCosts& /*unit*/, CostInputs& load) const override {
        load.lit_surfaces = std::max(load.lit_surfaces, litSurfaces(material_flags_));
    }
    // However few pixels have any.
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kLayers, timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return costs.shadedLoop(by_ids_ ? costs.unit().compute : costs.unit().fragment);
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(frame.costs),
                by_ids_ ? recordVisibilityLayers : recordRaster);
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override {
        by_ids_ = frame.byIds();
        material_flags_ = shadedById(inputs, frame);
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        return by_ids_ ? costs.resolved(true) : costs.shadedSurfaces(1);
    }
    // Of surfaces at the same depth one with layers stays, whichever was drawn last.
    static void recordRaster(const FrameContext& frame, const vk::Rect2D& part) {
        using LoadOp = vk::AttachmentLoadOp;
        std::vector<DrawGroup> layered;
        std::ranges::copy_if(
            frame.draws.solid, std::back_inserter(layered),
            [](const DrawGroup& it) { return (it.material_flags & io::kMaterialLayers) != 0; });
        const auto pass = GeometryPass::kForwardAfterDepth;
        inGroups(frame, pass, layered, [&](const auto& groups, bool) {
            const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kLayers);
            const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
            const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
            const Rendering rendering(frame, part, colors, &depth);
            drawGroups(frame, pass, groups);
        });
    }

    bool by_ids_ = false;
    MaterialFlags material_flags_ = 0; // shadedById()
};

std::string wordsOfLayers(const PlanInputs& inputs, const StepPlan* plan) {
    if (plan == nullptr) {
        return {};
    }
    return inputs.plan.byIds()
               ? "layers: a compute pass shades materials with layers again over the lit picture, "
                 "because the G-buffer has no room for them"
               : "layers: the forward shader draws materials with layers again over the lit "
                 "picture, because the G-buffer has no room for them";
}

} // namespace

const StepRow kLayersStep{.name = pass::kLayers,
                          .part = StepPart::kPicture,
                          .plan =
                              [](const PlanInputs& inputs) {
                                  return drawsLayers(inputs.settings, inputs.facts.layers_visible)
                                             ? std::optional(StepPlan{})
                                             : std::nullopt;
                              },
                          .uses =
                              [](const FramePlan& frame, const StepPlan&) {
                                  return frame.byIds()
                                             ? withLights({use::loaded(Resource::kPosed),
                                                           use::sampled(Resource::kIds),
                                                           use::sampled(Resource::kDepth),
                                                           use::stored(Resource::kRadiance)},
                                                          use::Stage::eComputeShader)
                                             : withLights({use::vertices(), use::depthTested(),
                                                           use::drawn(Resource::kRadiance)},
                                                          use::Stage::eFragmentShader);
                              },
                          .words = wordsOfLayers,
                          .make = makeStep<Layers>};

} // namespace froxel::render
