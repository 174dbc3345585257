// Exposure and tone map, where no earlier pass does them: radiance into packed colours of the
// display.
#include "embedded.h"
#include "interface/constants.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/screen_pass.h"

#include <algorithm>
#include <string>

namespace froxel::render {

namespace {

constexpr uint32_t kSamples = 1U << 0U; // of StepPlan::way: four a pixel, averaged as colours

struct TonemapPipelines : ScreenPipelines {
    explicit TonemapPipelines(DeviceResources& shared)
        : ScreenPipelines(
              shared, [](const VariantKey&) { return shaders::tonemap_comp(); }, pass::kTonemap) {}
};

class Tonemap final : public Step {
  public:
    explicit Tonemap(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kTonemap, timeOver(costs.screen(), costs.load().size.shown)});
    }
    void record(const FrameContext& frame) const override {
        const uint32_t samples = (plan().way & kSamples) != 0 ? io::kOutputSamples : 0U;
        const VariantKey key{0, 0, frame.plan.tone_output_flags | samples};
        inParts(frame, frame.shown(), frame.costs.screen(),
                [&key](const FrameContext& at, const vk::Rect2D& part) {
                    recordScreenPass<TonemapPipelines>(at, pass::kTonemap, key, part);
                });
    }
};

// The last step before this one that touches radiance; null: none does.
const PlannedStep* lastOverRadiance(const FramePlan& frame) {
    const PlannedStep* last = nullptr;
    for (const PlannedStep& step : frame.steps) {
        if (step.row == &kTonemapStep) {
            break;
        }
        last = step.touches(Resource::kRadiance) ? &step : last;
    }
    return last;
}

std::optional<StepPlan> planOfTonemap(const PlanInputs& inputs) {
    const PlannedStep* last = lastOverRadiance(inputs.plan);
    if (last != nullptr && last->plan.can_pack) {
        return {};
    }
    const bool samples = settings::samplesAcross(inputs.settings.antialiasing) > 1;
    return StepPlan{.way = samples ? kSamples : 0U, .can_pack = true};
}

std::string wordsOfTonemap(const PlanInputs& inputs, const StepPlan* plan) {
    const FramePlan& frame = inputs.plan;
    if (settings::replacesPicture(frame.debug)) {
        return {};
    }
    if (plan == nullptr) {
        return std::string("tone mapping in the ") +
               (frame.find(kToonStep) != nullptr ? kToonStep : kLightingStep).name +
               " pass: no separate pass";
    }
    const PlannedStep* last = lastOverRadiance(frame);
    const std::string where = "tone mapping in a separate pass, after ";
    if (frame.find(kBlendedStep) != nullptr) {
        return where + "blending";
    }
    if (settings::isOverlay(frame.debug)) {
        return where + "the debug view's lines";
    }
    const bool lit_alone =
        last == nullptr || last->row == &kForwardStep || last->row == &kLightingStep;
    return where + (lit_alone && (plan->way & kSamples) == 0 ? "a fragment stage"
                                                             : "the passes over the lit picture");
}

} // namespace

const StepRow kTonemapStep{.name = pass::kTonemap,
                           .part = StepPart::kPicture,
                           .plan = planOfTonemap,
                           .uses =
                               [](const FramePlan&, const StepPlan& plan) {
                                   return std::vector{
                                       use::loaded(Resource::kRadiance),
                                       use::stored(plan.packs.value_or(Resource::kPixels))};
                               },
                           .words = wordsOfTonemap,
                           .make = makeStep<Tonemap>};

} // namespace froxel::render
