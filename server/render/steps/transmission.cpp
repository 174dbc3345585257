// Surfaces that light passes as through glass: their layers, the farthest first, are drawn over the
// picture, of which each sees a copy: what is solid, and the layers behind it.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/steps/transmission_targets.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_binding.h"
#include "render/surfaces/visibility_passes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using LoadOp = vk::AttachmentLoadOp;
using Stage = vk::PipelineStageFlagBits2;

// Shared by every view.
class BehindPipelines {
  public:
    explicit BehindPipelines(DeviceResources& shared)
        : device_(shared.device),
          layout_(gpu::makePipelineLayout(device_,
                                          {shared.pipelines.frameLayout(),
                                           shared.pipelines.screenLayout(), levelLayout(shared)},
                                          sizeof(uint32_t))),
          level_layout_(gpu::makePipelineLayout(device_, {levelLayout(shared)})),
          made_(shared.timeline, shared.variants, 2 * settings::kToneMapNames.size()),
          level_(gpu::makeComputePipeline(
              device_, shaders::behind_level_comp(), {}, *level_layout_, "level behind")) {}

    // in_tiles: of a layer alone. May throw VariantsMissing.
    [[nodiscard]] vk::Pipeline copy(uint32_t output_flags, bool in_tiles) {
        return *made_.findOrMake(std::pair(output_flags, in_tiles), [=, this] {
            return gpu::makeComputePipeline(
                device_, in_tiles ? shaders::behind_tiles_comp() : shaders::behind_comp(),

                specConstants({0, 0, output_flags}, device_.traits()), *layout_, pass::kBehind);
        });
    }
    [[nodiscard]] SharedPipeline& level() { return level_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }
    [[nodiscard]] vk::PipelineLayout levelLayout() const { return *level_layout_; }

  private:
    static vk::DescriptorSetLayout levelLayout(DeviceResources& shared) {
        return *shared.stored<TransmissionLayouts>().level_layout;
    }

    const gpu::Device& device_;
    vk::raii::PipelineLayout layout_;
    vk::raii::PipelineLayout level_layout_;
    VariantCache<std::pair<uint32_t, bool>> made_;
    SharedPipeline level_;
};

// Of a region, in texels of a level of half the sides; with what its neighbours take of it. Corners
// are those of workgroups.
vk::Rect2D coarser(const vk::Rect2D& region, const vk::Extent2D& extent) {
    constexpr auto kGroup = static_cast<int32_t>(io::kScreenGroup);
    const auto low = [](int32_t at) { return std::max((at / 2 - 1) / kGroup * kGroup, 0); };
    const auto high = [](int32_t at, uint32_t side, uint32_t most) {
        return std::min((at + static_cast<int32_t>(side) + 1) / 2 + 1, static_cast<int32_t>(most));
    };
    const vk::Offset2D from{low(region.offset.x), low(region.offset.y)};
    return {
        from,
        {static_cast<uint32_t>(high(region.offset.x, region.extent.width, extent.width) - from.x),
         static_cast<uint32_t>(high(region.offset.y, region.extent.height, extent.height) -
                               from.y)}};
}

// Texels of a level around a point that its lookup takes from, by the spline, by means of finer
// levels, and by the level after it: a little more.
constexpr float kReach = 8;

// On every side, within the picture; corners stay those of workgroups.
vk::Rect2D grown(const vk::Rect2D& region, float by_px, const settings::Size& size) {
    const auto by = static_cast<int32_t>(std::min(by_px, 65536.0F));
    const auto low = [by](int32_t at) {
        constexpr auto kGroup = static_cast<int32_t>(io::kScreenGroup);
        return std::max(at - by, 0) / kGroup * kGroup;
    };
    const vk::Offset2D from{low(region.offset.x), low(region.offset.y)};
    const auto side = [by](int32_t at, uint32_t extent, int32_t first, uint32_t most) {
        const int32_t end =
            std::min(at + static_cast<int32_t>(extent) + by, static_cast<int32_t>(most));
        return static_cast<uint32_t>(end - first);
    };
    return {from,
            {side(region.offset.x, region.extent.width, from.x, size.width_px),
             side(region.offset.y, region.extent.height, from.y, size.height_px)}};
}

// Each of a surface's pixels is in one of so many layers. The parts of meshlets overlap by far more
// than their triangles do: the nearest layer is taken to have all of them, up to the whole picture,
// and the others together no more than that.
RegionCost layerCost(const FrameCosts& costs, uint32_t layer, uint32_t layer_count) {
    const RegionCost all = costs.layered(costs.load().draws.transmissive);
    const RegionCost whole = costs.shadedSurfaces(1);
    return {all.each,
            [=](const vk::Rect2D& region) {
                const Seconds sum = all.of(region);
                const Seconds nearest = std::min(sum, whole.of(region));
                const Seconds others = std::min(sum - nearest, nearest);
                return layer == 0 ? nearest : others / (layer_count - 1.0);
            },
            all.least};
}

class Transmission final : public Step {
  public:
    explicit Transmission(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override;
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return costs.shadedLoop(byIds() ? costs.unit().compute : costs.unit().fragment);
    }
    void record(const FrameContext& frame) const override {
        for (uint32_t layer = shape_.layer_count; layer-- > 0;) {
            recordBehind(frame, layer);
            recordLayer(frame, layer);
        }
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        drawn_ = inputs.size.drawn;
        shape_ = transmissionShape(scene_, inputs, plan());
        visible_ = layersById(scene_, inputs, plan());

        const LayeredDraws& draws = inputs.draws.transmissive;
        covered_ = around(draws.parts);
        const float highest = highestLevel(scene_, inputs);
        levels_built_ = std::min(shape_.level_count, static_cast<uint32_t>(highest) + 2);
        seen_ = around(draws.seen_parts);
        if (highest > 0) {
            seen_ = grown(seen_, std::exp2(std::ceil(highest)) * kReach, drawn_);
        }
        return {};
    }
    [[nodiscard]] bool byIds() const { return (plan().way & kLayersByIds) != 0; }
    // Of what the farthest layer sees; of the others what differs from that, where surfaces are.
    [[nodiscard]] const vk::Rect2D& regionBehind(uint32_t layer) const {
        return layer + 1 == shape_.layer_count ? seen_ : covered_;
    }
    [[nodiscard]] static RegionCost behindCost(const FrameCosts& costs, const vk::Rect2D& region);
    [[nodiscard]] Seconds levelsCost(const FrameCosts& costs, const vk::Rect2D& region) const;
    void recordBehind(const FrameContext& frame, uint32_t layer) const;
    void copyBehind(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) const;
    void recordLevels(const FrameContext& frame, vk::Rect2D region) const;
    // Whether a part is all that layers cover, so that their tiles are all there is to do.
    [[nodiscard]] bool inTiles(const vk::Rect2D& part) const {
        return byIds() && part == covered_ &&
               layerTileCount(drawn_) <= scene_.shared.device.limits().maxComputeWorkGroupCount[0];
    }

    void recordLayer(const FrameContext& frame, uint32_t layer) const;
    static void drawLayer(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer);
    void shadeLayer(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) const;

    SceneResources& scene_;
    settings::Size drawn_;
    TransmissionShape shape_;
    vk::Rect2D covered_; // by surfaces
    vk::Rect2D seen_;    // what these may see
    uint32_t levels_built_ = 1;
    VisibilityScene* visible_ = nullptr; // by ids: of the frame's materials
};

RegionCost Transmission::behindCost(const FrameCosts& costs, const vk::Rect2D& region) {
    const double each = costs.unit().screen_pixel;
    return {Seconds(0), [each, region](const vk::Rect2D& part) {
                return Seconds(areaOf(common(part, region)) * each);
            }};
}

// A third as many texels as the finest level has.
Seconds Transmission::levelsCost(const FrameCosts& costs, const vk::Rect2D& region) const {
    return Seconds(shape_.level_count > 1 ? areaOf(region) * costs.unit().screen_pixel / 3 : 0.0);
}

void Transmission::addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const {
    Seconds behind{0};
    for (uint32_t layer = 0; layer < shape_.layer_count; ++layer) {
        const vk::Rect2D& region = regionBehind(layer);
        behind += timeOver(behindCost(costs, region), drawn_) + levelsCost(costs, region);
    }
    passes.push_back({pass::kBehind, behind});
    Seconds drawn{0};
    for (uint32_t layer = 0; layer < shape_.layer_count; ++layer) {
        drawn += timeOver(layerCost(costs, layer, shape_.layer_count), drawn_);
    }
    passes.push_back({pass::kTransmission, drawn});
}

void Transmission::recordBehind(const FrameContext& frame, uint32_t layer) const {
    const vk::Rect2D& region = regionBehind(layer);
    // the picture, what earlier layers still look up -> loads and stores of compute
    byIds() ? nextComputePass(frame.slot.cmd)
            : barrier(frame.slot.cmd, Stage::eColorAttachmentOutput | Stage::eFragmentShader,
                      Access::eColorAttachmentWrite, Stage::eComputeShader, use::kLoadStore);
    inParts(frame, frame.drawn(), behindCost(frame.costs, region),
            [this, &region, layer](const FrameContext& at, const vk::Rect2D& part) {
                const vk::Rect2D both = common(part, region);
                if (both.extent.width == 0) {
                    return;
                }
                copyBehind(at, both, layer);
            });
    if (shape_.level_count > 1) {
        recordLevels(frame, region);
    }
    // the picture behind -> lookups; loads of the picture -> blending
    byIds() ? nextComputePass(frame.slot.cmd)
            : barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                      Stage::eFragmentShader | Stage::eColorAttachmentOutput,
                      Access::eShaderSampledRead | Access::eColorAttachmentRead |
                          Access::eColorAttachmentWrite);
}

void Transmission::copyBehind(const FrameContext& frame,
                              const vk::Rect2D& part,
                              uint32_t layer) const {
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kBehind);
    auto& pipelines = frame.scene.shared.stored<BehindPipelines>();
    const bool changed_alone = layer + 1 < shape_.layer_count && inTiles(part);
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute,
                     pipelines.copy(frame.plan.tone_output_flags, changed_alone));
    const auto& targets = transmissionTargets(frame);
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set, targets.levelSet(0)};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0, sets, {});
    if (changed_alone) {
        cmd.pushConstants<uint32_t>(pipelines.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                    layer + 1);
        dispatchTiles(frame, *targets.tiles.handle, layer + 1);
    } else {
        dispatchOver(cmd, part);
    }
}

void Transmission::recordLevels(const FrameContext& frame, vk::Rect2D region) const {
    frame.pieces.add(levelsCost(frame.costs, region));
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kBehind);
    auto& pipelines = scene_.shared.stored<BehindPipelines>();
    pipelines.level().bind(cmd, scene_.shared.variants);
    const auto& targets = transmissionTargets(frame);
    for (uint32_t level = 1; level < levels_built_; ++level) {
        nextComputePass(cmd);
        region = coarser(region, targets.levelExtent(level));
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.levelLayout(), 0,
                               targets.levelSet(level), {});
        dispatchOver(cmd, region);
    }
}

void Transmission::recordLayer(const FrameContext& frame, uint32_t layer) const {
    inParts(frame, frame.drawn(), layerCost(frame.costs, layer, shape_.layer_count),
            [this, layer](const FrameContext& at, const vk::Rect2D& part) {
                const vk::Rect2D both = common(part, covered_);
                if (both.extent.width > 0) {
                    byIds() ? shadeLayer(at, both, layer) : drawLayer(at, both, layer);
                }
            });
}

void Transmission::shadeLayer(const FrameContext& frame,
                              const vk::Rect2D& part,
                              uint32_t layer) const {
    FrameContext of_layers = frame;
    of_layers.visibility = visible_;
    const auto& targets = transmissionTargets(frame);
    recordVisibilityTransmission(of_layers, part, targets.behindSet(), layer,
                                 inTiles(part) ? *targets.tiles.handle : vk::Buffer{});
}

void Transmission::drawLayer(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) {
    const auto pass = GeometryPass::kTransmission;
    inGroups(frame, pass, frame.draws.transmissive.groups, [&](const auto& groups, bool) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransmission);
        const auto& targets = transmissionTargets(frame);
        const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
        const auto depth = attachment(targets.layer_depths[layer], LoadOp::eLoad);
        const Rendering rendering(frame, part, colors, &depth);
        bindTransmission(frame, targets.behindSet());
        drawGroups(frame, pass, groups);
    });
}

std::string wordsOfTransmission(const PlanInputs& inputs, const StepPlan* plan) {
    if (settings::replacesPicture(inputs.plan.debug)) {
        return {};
    }
    return plan == nullptr
               ? std::string("no surface in view that transmits light: no copy of the picture")
               : "surfaces in view that transmit light: up to " + std::to_string(plan->count) +
                     " layers, each drawn " +
                     ((plan->way & kLayersByIds) != 0 ? "from ids in compute " : "") +
                     "over a copy of the picture behind it";
}

std::vector<Use> usesOfTransmission(const FramePlan& /*frame*/, const StepPlan& plan) {
    if ((plan.way & kLayersByIds) != 0) {
        return withLights(
            {use::loaded(Resource::kPosed),
             use::sampled(Resource::kDepth),
             {Resource::kTransmissiveDepth, Stage::eComputeShader | Stage::eDrawIndirect,
              Access::eShaderStorageRead | Access::eIndirectCommandRead},
             use::stored(Resource::kRadiance)},
            Stage::eComputeShader);
    }
    return withLights(
        {use::vertices(),
         use::sampled(Resource::kDepth, Stage::eFragmentShader),
         {Resource::kTransmissiveDepth, kDepthStages, Access::eDepthStencilAttachmentRead},
         use::loaded(Resource::kRadiance),
         use::drawn(Resource::kRadiance)},
        Stage::eFragmentShader);
}

} // namespace

const StepRow kTransmissionStep{.name = pass::kTransmission,
                                .part = StepPart::kPicture,
                                .plan = planOfTransmission,
                                .uses = usesOfTransmission,
                                .words = wordsOfTransmission,
                                .make = makeStep<Transmission>};

} // namespace froxel::render
