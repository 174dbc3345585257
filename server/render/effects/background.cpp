#include "render/effects/background.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/effects/environment.h"
#include "render/frame/effect.h"
#include "render/frame/frame_context.h"
#include "render/frame/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"

#include <array>

namespace froxel::render {

namespace {

// Shared by every view.
struct BackgroundPipeline {
    explicit BackgroundPipeline(const DeviceResources& shared)
        : pipeline(gpu::makeComputePipeline(shared.device,
                                            shaders::background_comp(),
                                            {},
                                            shared.pipelines.screenPipelineLayout(),
                                            "background")) {}

    SharedPipeline pipeline;
};

class Background final : public Effect {
  public:
    explicit Background(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kBackground, timeOver(costOf(costs), costs.load().drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.slot.targets->size, costOf(frame.costs), recordPart);
    }

  private:
    static RegionCost costOf(const FrameCosts& costs) {
        const double each = costs.unit().screen_pixel + onDevice(costs.unit(), kEnvironmentLookup);
        return {Seconds(0),
                [each](const vk::Rect2D& region) { return Seconds(areaOf(region) * each); }};
    }
    // Reads depth, writes radiance.
    static void recordPart(const FrameContext& frame, const vk::Rect2D& region) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBackground);
        const auto& cmd = frame.slot.cmd;
        frame.scene.shared.stored<BackgroundPipeline>().pipeline.bind(cmd,
                                                                      frame.scene.shared.variants);
        const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute,
                               frame.scene.shared.pipelines.screenPipelineLayout(), 0, sets, {});
        dispatchOver(cmd, region);
    }
};

std::optional<EffectPlan> planOfBackground(const settings::ViewSettings& settings,
                                           const FrameFacts& /*facts*/) {
    return hasEnvironment(settings) && settings.environment.background ? std::optional(EffectPlan{})
                                                                       : std::nullopt;
}

} // namespace

const EffectRow kBackgroundEffect{
    .place = EffectPlace::kSolid,
    .plan = planOfBackground,
    .words =
        [](const settings::ViewSettings&, const EffectPlan&) {
            return std::string(
                "background: a separate pass shows the environment behind the scene");
        },
    .make = makeEffect<Background>};

} // namespace froxel::render
