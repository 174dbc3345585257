// Lighting of the G-buffer, in compute or in the fragment stage.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/screen_pass.h"

#include <array>

namespace froxel::render {

namespace {

bool batches(const VariantKey& key) {
    return (key.light_flags & io::kLightBatched) != 0;
}

// Shared by every view, like what follows.
struct LightingPipelines : ScreenPipelines {
    explicit LightingPipelines(DeviceResources& shared)
        : ScreenPipelines(
              shared,
              [](const VariantKey& key) {
                  return batches(key) ? shaders::lighting_batched_comp() : shaders::lighting_comp();
              },
              "lighting") {}
};

class FragmentLightingPipelines {
  public:
    explicit FragmentLightingPipelines(DeviceResources& shared)
        : device_(shared.device), layout_(shared.pipelines.screenPipelineLayout()),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {
        shared.listVariants([this](std::vector<Pipelines::Made>& all) {
            made_.forEachKey([&](const auto& id) { all.push_back({kName, std::get<1>(id)}); });
        });
    }
    FragmentLightingPipelines(const FragmentLightingPipelines&) = delete;
    FragmentLightingPipelines& operator=(const FragmentLightingPipelines&) = delete;

    // covered_alone: with the depth buffer attached, at whose empty pixels it does not run.
    [[nodiscard]] vk::Pipeline find(const VariantKey& key, bool covered_alone) {
        return *made_.findOrMake(std::tuple(covered_alone, key), [=, this] {
            gpu::GraphicsPipelineInfo info;
            info.vertex = shaders::fullscreen_vert();
            info.fragment =
                batches(key) ? shaders::lighting_batched_frag() : shaders::lighting_frag();
            info.constants = specConstants(key, device_.traits());
            info.layout = layout_;
            info.color_formats = {Pipelines::kRadianceFormat};
            if (covered_alone) { // it is drawn at the far end
                info.depth_format = Pipelines::kDepthFormat;
                info.depth_compare = vk::CompareOp::eLess;
                info.depth_write = false;
            }
            return gpu::makeGraphicsPipeline(device_, info, kName);
        });
    }

  private:
    static constexpr std::string_view kName = "lighting (fragment)";

    const gpu::Device& device_;
    vk::PipelineLayout layout_;
    VariantCache<std::tuple<bool, VariantKey>> made_;
};

class Lighting final : public Step {
  public:
    explicit Lighting(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kLighting, timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return pairCost(costs).loop;
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    const VariantKey key{0, at.plan.lighting_light_flags,
                                         at.plan.gbuffer_output_flags |
                                             (in_compute_ ? packingFlags(at.plan, plan()) : 0U)};
                    in_compute_
                        ? recordScreenPass<LightingPipelines>(at, pass::kLighting, key, part)
                        : recordFragments(at, key, part);
                });
    }

  private:
    Result<void> build(const StepInputs& /*inputs*/, const FramePlan& frame) override {
        in_compute_ = frame.lights_in_compute;
        return {};
    }
    [[nodiscard]] const PairCost& pairCost(const FrameCosts& costs) const {
        return in_compute_ ? costs.unit().compute : costs.unit().fragment;
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        return costs.shading(pairCost(costs));
    }
    static void
    recordFragments(const FrameContext& frame, const VariantKey& key, const vk::Rect2D& part);

    bool in_compute_ = false;
};

void Lighting::recordFragments(const FrameContext& frame,
                               const VariantKey& key,
                               const vk::Rect2D& part) {
    using LoadOp = vk::AttachmentLoadOp;
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kLighting);
    // Where compute rasters, the depth buffer is another image.
    const bool covered_alone = frame.plan.geometry != SolidGeometry::kComputeIds;
    const std::array colors = {attachment(frame.slot.targets->radiance,
                                          covered_alone ? LoadOp::eClear : LoadOp::eDontCare,
                                          nothing())};
    auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
    depth.storeOp = vk::AttachmentStoreOp::eNone; // the shader loads it, too
    const Rendering rendering(frame, part, colors, covered_alone ? &depth : nullptr);
    bindScreen(frame, vk::PipelineBindPoint::eGraphics,
               frame.scene.shared.stored<FragmentLightingPipelines>().find(key, covered_alone));
    frame.slot.cmd.setCullMode(vk::CullModeFlagBits::eNone);
    frame.slot.cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    frame.slot.cmd.draw(3, 1, 0, 0);
}

std::optional<StepPlan> planOfLighting(const PlanInputs& inputs) {
    if (inputs.plan.solid != Solid::kDeferred) {
        return {};
    }
    return StepPlan{.can_pack = inputs.plan.lights_in_compute && canPack(inputs.settings)};
}

std::vector<Use> usesOfLighting(const FramePlan& frame, const StepPlan& plan) {
    if (frame.lights_in_compute) {
        return withPacking(
            withLights({use::sampled(Resource::kGbuffer), use::sampled(Resource::kDepth)},
                       use::Stage::eComputeShader),
            plan);
    }
    return withLights({use::sampled(Resource::kGbuffer, use::Stage::eFragmentShader),
                       {Resource::kDepth, kDepthStages | use::Stage::eFragmentShader,
                        use::Access::eDepthStencilAttachmentRead | use::Access::eShaderSampledRead},
                       use::drawn(Resource::kRadiance)},
                      use::Stage::eFragmentShader);
}

} // namespace

const StepRow kLightingStep{.name = pass::kLighting,
                            .part = StepPart::kPicture,
                            .plan = planOfLighting,
                            .uses = usesOfLighting,
                            .make = makeStep<Lighting>};

} // namespace froxel::render
