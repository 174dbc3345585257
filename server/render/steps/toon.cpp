// The colour's bands, and with them the end of a deferred frame whose lights have none of their
// own.
#include "embedded.h"
#include "interface/constants.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/surfaces/screen_pass.h"

#include <string>

namespace froxel::render {

namespace {

constexpr uint32_t kBands = 1U << 0U; // of StepPlan::way

struct ToonPipelines : ScreenPipelines {
    explicit ToonPipelines(DeviceResources& shared)
        : ScreenPipelines(
              shared, [](const VariantKey&) { return shaders::toon_comp(); }, pass::kToon) {}
};

class Toon final : public Step {
  public:
    explicit Toon(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kToon, timeOver(costs.screen(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        const uint32_t lights = (plan().way & kBands) != 0 ? io::kLightBands : 0U;
        const VariantKey key{0, lights, packingFlags(frame.plan, plan())};
        inParts(frame, frame.drawn(), frame.costs.screen(),
                [&key](const FrameContext& at, const vk::Rect2D& part) {
                    recordScreenPass<ToonPipelines>(at, pass::kToon, key, part);
                });
    }
};

std::optional<StepPlan> planOfToon(const PlanInputs& inputs) {
    if (inputs.settings.renderer != settings::Renderer::kToonCompute) {
        return {};
    }
    return StepPlan{.way = inputs.settings.toon.bands > 0 ? kBands : 0U,
                    .can_pack = canPack(inputs.settings)};
}

std::string wordsOfToon(const PlanInputs& inputs, const StepPlan* plan) {
    return plan != nullptr && (plan->way & kBands) != 0
               ? std::to_string(inputs.settings.toon.bands) + " toon bands of the lit colour"
               : std::string();
}

} // namespace

const StepRow kToonStep{
    .name = pass::kToon,
    .part = StepPart::kPicture,
    .plan = planOfToon,
    .uses =
        [](const FramePlan&, const StepPlan& plan) {
            return withPacking({use::sampled(Resource::kDepth), use::loaded(Resource::kRadiance)},
                               plan);
        },
    .words = wordsOfToon,
    .make = makeStep<Toon>};

} // namespace froxel::render
