// A debug view in the picture's place: a value of each pixel as a colour.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/debug_io.h"
#include "render/frame/step.h"
#include "render/lists/counting_flags.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/screen_pass.h"

#include <array>

namespace froxel::render {

namespace {

// What the view's part of the shader looks at.
VariantKey valuesKey(settings::DebugView view,
                     uint32_t light_flags,
                     uint32_t output_flags,
                     bool device_is_cpu) {
    using View = settings::DebugView;
    const bool packed = view == View::kPosition || view == View::kNormal ||
                        view == View::kBaseColor || view == View::kRoughness;
    const bool lists = settings::countsLights(view) || settings::showsClusters(view);
    return {static_cast<uint32_t>(view), lists ? countingFlags(light_flags, device_is_cpu) : 0U,
            packed ? output_flags : 0U};
}

// Shared by every view.
class DebugPipelines {
  public:
    explicit DebugPipelines(DeviceResources& shared)
        : device_(shared.device), layout_(gpu::makePipelineLayout(device_,
                                                                  {shared.pipelines.frameLayout(),
                                                                   shared.pipelines.screenLayout()},
                                                                  sizeof(io::DebugFrame))),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    [[nodiscard]] vk::Pipeline find(const VariantKey& key) {
        return *made_.findOrMake(key, [=, this] {
            return gpu::makeComputePipeline(device_, shaders::debug_view_comp(),
                                            specConstants(key, device_.traits()), *layout_,
                                            "debug view");
        });
    }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::PipelineLayout layout_;
    VariantCache<VariantKey> made_;
};

class DebugPicture final : public Step {
  public:
    explicit DebugPicture(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kDebugView, timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return settings::testsLights(view_) ? costs.unit().counting.loop : 0;
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) { recordPart(at, part); });
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override {
        view_ = frame.debug;
        debug_ = &inputs.debug;
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        return settings::testsLights(view_) ? costs.shading(costs.unit().counting) : costs.screen();
    }
    void recordPart(const FrameContext& frame, const vk::Rect2D& part) const {
        const auto& cmd = frame.slot.cmd;
        const auto& shared = frame.scene.shared;
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kDebugView);
        auto& pipelines = frame.scene.shared.stored<DebugPipelines>();
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute,
                         pipelines.find(valuesKey(view_, frame.plan.lighting_light_flags,
                                                  frame.plan.gbuffer_output_flags,
                                                  shared.device.traits().is_cpu)));
        const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0, sets, {});
        cmd.pushConstants<io::DebugFrame>(pipelines.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                          debug_->values);
        dispatchOver(cmd, part);
    }

    settings::DebugView view_ = settings::DebugView::kNone;
    const DebugFrame* debug_ = nullptr; // the view's own
};

std::vector<Use> usesOfDebugView(const FramePlan& frame, const StepPlan& plan) {
    std::vector uses = {use::sampled(Resource::kDepth), use::sampled(Resource::kLists),
                        use::stored(plan.packs.value_or(Resource::kPixels))};
    if (frame.solid == Solid::kShownGbuffer) {
        uses.push_back(use::sampled(Resource::kGbuffer));
    } else if (frame.solid == Solid::kFragments) {
        uses.push_back(use::loaded(Resource::kRadiance));
    }
    return uses;
}

} // namespace

const StepRow kDebugViewStep{.name = pass::kDebugView,
                             .plan =
                                 [](const PlanInputs& inputs) {
                                     return settings::replacesPicture(inputs.plan.debug)
                                                ? std::optional(StepPlan{.can_pack = true})
                                                : std::nullopt;
                                 },
                             .uses = usesOfDebugView,
                             .make = makeStep<DebugPicture>};

} // namespace froxel::render
