// Surfaces that are blended over the solid picture: sorted and drawn over it at once; or summed by
// weights, or peeled layer by layer, into targets of their own, which then come over it.
#include "gpu/sample_counter.h"
#include "interface/constants.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/steps/blend_targets.h"
#include "render/steps/order.h"
#include "render/steps/packing.h"
#include "render/steps/transmission_targets.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/raster_passes.h"
#include "render/surfaces/rendering_scope.h"

#include <algorithm>
#include <array>
#include <string>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using LoadOp = vk::AttachmentLoadOp;
using Stage = vk::PipelineStageFlagBits2;
using settings::Transparency;

// Layers that were peeled, and pixels that have more: the farther ones are left out.
constexpr std::array kPeelStats = {StatRow{"peel", "layers", "layers"},
                                   StatRow{"peel", "overflow_pixels", "overflow_pixels"}};
constexpr const StatRow& kLayers = kPeelStats[0];
constexpr const StatRow& kOverflow = kPeelStats[1];

// Of StepPlan::way.
constexpr uint32_t kOverUnlit = 1U << 0U; // what is blended may be before colours of the display
constexpr uint32_t kWeighted = 1U << 1U;
constexpr uint32_t kPeeled = 1U << 2U;

Transparency transparencyOf(const StepPlan& plan) {
    return (plan.way & kPeeled) != 0     ? Transparency::kPeeled
           : (plan.way & kWeighted) != 0 ? Transparency::kWeighted
                                         : Transparency::kSorted;
}

vk::ClearValue clearColor(float rgb, float alpha) {
    return vk::ClearColorValue(std::array{rgb, rgb, rgb, alpha});
}

void bindLayer(const FrameContext& frame, vk::DescriptorSet set) {
    frame.slot.cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics,
                                      frame.scene.shared.pipelines.toldPipelineLayout(), 2, set,
                                      {});
}

const BlendTargets& targetsOf(const FrameContext& frame) {
    return frame.slot.step_targets.get<BlendTargets>();
}

// Of a frame slot.
struct PeelOverflow {
    explicit PeelOverflow(const gpu::Device& device) : counter(device) {}

    gpu::SampleCounter counter;
    bool counts = false; // in the slot's frame
};

// Solid depth that compute rastered -> the rasteriser's, by way of the words' buffer.
void recordDepthHandover(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    recordDepthOut(frame);
    // first copy -> second
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, Stage::eCopy, Access::eTransferRead);
    recordDepthIn(frame);
    // copied depth -> depth test
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, kDepthStages,
            Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
}

// Which triangle of each pixel the layer is, behind the one before.
void recordPeelSelect(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) {
    const auto& targets = targetsOf(frame);
    const vk::ClearValue none = vk::ClearColorValue(std::array<uint32_t, 4>{});
    const std::array colors = {
        attachment(targets.layer_keys[layer % targets.layer_keys.size()], LoadOp::eClear, none)};
    const auto depth = attachment(targets.layer_depth, LoadOp::eClear, farDepth());
    const Rendering rendering(frame, part, colors, &depth);
    bindLayer(frame, targets.selectSet(layer));
    drawGroups(frame, GeometryPass::kPeelSelect, frame.draws.transparent.groups, layer);
}

// What that looks like, under the layers before.
void recordPeelShade(const FrameContext& frame, const vk::Rect2D& part, uint32_t layer) {
    const auto& targets = targetsOf(frame);
    const std::array colors = {
        attachment(targets.sums, layer == 0 ? LoadOp::eClear : LoadOp::eLoad, clearColor(0, 0))};
    const auto depth = attachment(targets.layer_depth, LoadOp::eLoad);
    const Rendering rendering(frame, part, colors, &depth);
    bindLayer(frame, targets.selectedSet(layer));
    drawGroups(frame, GeometryPass::kPeelShade, frame.draws.transparent.groups, layer);
}

// Pixels that have yet another layer, by an occlusion query.
void recordPeelCount(const FrameContext& frame, const vk::Rect2D& part, uint32_t layers) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kPeelCount);
    const auto& targets = targetsOf(frame);
    auto& counter = frame.slot.stored.get<PeelOverflow>().counter;
    counter.begin(frame.slot.cmd);
    {
        const auto depth = attachment(targets.layer_depth, LoadOp::eClear, farDepth());
        const Rendering rendering(frame, part, {}, &depth);
        bindLayer(frame, targets.selectSet(layers));
        drawGroups(frame, GeometryPass::kPeelCount, frame.draws.transparent.groups, layers);
    }
    counter.end(frame.slot.cmd);
}

void recordWeighted(const FrameContext& frame, const vk::Rect2D& part) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kWeighted);
    const auto& targets = targetsOf(frame);
    const std::array colors = {attachment(targets.sums, LoadOp::eClear, clearColor(0, 1)),
                               attachment(targets.weights, LoadOp::eClear, clearColor(0, 0))};
    const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
    const Rendering rendering(frame, part, colors, &depth);
    drawGroups(frame, GeometryPass::kWeighted, frame.draws.transparent.groups);
}

// Solid depth to where the rasteriser tests it.
void handDepthOver(const FrameContext& frame) {
    if (frame.plan.geometry == SolidGeometry::kComputeIds) {
        recordDepthHandover(frame);
    }
}

// Behind what transmits light, in whatever way the others are blended.
class BlendedBehind final : public Step {
  public:
    explicit BlendedBehind(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back(
            {pass::kTransparentBehind, timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return costs.shadedLoop(costs.unit().fragment);
    }
    void record(const FrameContext& frame) const override {
        handDepthOver(frame);
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    const vk::Rect2D both = common(part, covered_);
                    if (both.extent.width > 0) {
                        recordPart(at, both);
                    }
                });
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        covered_ = around(inputs.draws.transmissive.parts);
        return {};
    }
    [[nodiscard]] RegionCost cost(const FrameCosts& costs) const {
        return within(costs.layered(costs.load().draws.transparent), covered_);
    }

    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const auto pass = GeometryPass::kTransparentBehind;
        inGroups(frame, pass, frame.draws.transparent.groups, [&](const auto& groups, bool) {
            const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd,
                                       pass::kTransparentBehind);
            const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
            const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
            const Rendering rendering(frame, part, colors, &depth);
            drawGroups(frame, pass, groups);
        });
    }

    vk::Rect2D covered_; // by surfaces that transmit light
};

class Blended final : public Step {
  public:
    explicit Blended(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override;
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return costs.shadedLoop(costs.unit().fragment);
    }
    void addMemory(NeedList& need) const override {
        if (apart()) {
            for (const auto& [name, info] : blendImages(transparencyOf(plan()), drawn_)) {
                need.image(name, info);
            }
        }
    }
    void addStats(FrameStats& stats) const override {
        if (layer_count_ > 0) {
            stats.steps.set(kLayers, layer_count_);
            stats.steps.set(kOverflow, 0);
        }
    }

    void freeUnfit(const ViewTargets* view) override {
        if (targets_ &&
            (!apart() || view == nullptr || !targets_->fits(transparencyOf(plan()), *view))) {
            targets_.reset();
        }
    }
    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;
    void record(const FrameContext& frame) const override;
    void
    addResults(const FrameSlot& slot, const StepPlan& /*its*/, FrameStats& stats) const override {
        // Whether it counts depends on the frame's triangles, besides its plan.
        if (const auto* of = slot.stored.find<PeelOverflow>(); of != nullptr && of->counts) {
            stats.steps.set(kOverflow,
                            static_cast<double>(slot.stored.get<PeelOverflow>().counter.read()));
        }
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override;
    [[nodiscard]] bool overUnlit() const { return (plan().way & kOverUnlit) != 0; }
    // Whether what is blended is drawn into targets of its own.
    [[nodiscard]] bool apart() const { return plan().way != 0; }
    // One pass over what is blended.
    static RegionCost cost(const FrameCosts& costs);
    void recordSorted(const FrameContext& frame, const vk::Rect2D& part) const;
    void recordPeeled(const FrameContext& frame) const;
    // What was blended apart, over the solid picture.
    void recordResolve(const FrameContext& frame) const;
    void recordResolvePart(const FrameContext& frame, const vk::Rect2D& part) const;
    void recordOverUnlitPart(const FrameContext& frame, const vk::Rect2D& part) const;

    SceneResources& scene_;
    settings::Size drawn_;
    uint32_t layer_count_ = 0;     // that peeling draws: no pixel has more than there are triangles
    bool counts_overflow_ = false; // pixels with more layers, since there can be any
    std::shared_ptr<BlendTargets> targets_; // null: the last frame has none
};

Result<void> Blended::build(const StepInputs& inputs, const FramePlan& /*frame*/) {
    drawn_ = inputs.settings.size;
    const uint32_t most = (plan().way & kPeeled) != 0 ? inputs.settings.peel_layers : 0;
    const uint32_t triangle_count = inputs.draws.transparent.triangle_count;
    layer_count_ = std::min(most, triangle_count);
    counts_overflow_ = most > 0 && triangle_count > most;
    return {};
}

RegionCost Blended::cost(const FrameCosts& costs) {
    return costs.layered(costs.load().draws.transparent);
}

void Blended::addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const {
    const bool peeled = (plan().way & kPeeled) != 0;
    const double count = peeled ? layer_count_ + (counts_overflow_ ? 1 : 0) : 1;
    passes.push_back({peeled ? pass::kPeel : pass::kTransparent,
                      count * timeOver(cost(costs), costs.load().size.drawn)});
    if (apart()) {
        passes.push_back({overUnlit() ? pass::kBlendOverUnlit : pass::kBlendResolve,
                          timeOver(costs.screen(), costs.load().size.drawn)});
    }
}

void Blended::prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) {
    if (apart()) {
        const Transparency transparency = transparencyOf(plan());
        if (targets_ && !targets_->fits(transparency, *slot.targets)) {
            targets_.reset(); // before its successor takes memory
        }
        if (!targets_) {
            targets_ = std::make_shared<BlendTargets>(scene_.shared.device, scene_.shared.pipelines,
                                                      transparency, slot.targets);
        }
        slot.step_targets.hold(targets_);
    }
    if (counts_overflow_) {
        slot.stored.findOrMake<PeelOverflow>(scene_.shared.device).counts = true;
    } else if (auto* of = slot.stored.find<PeelOverflow>()) {
        of->counts = false;
    }
}

void Blended::record(const FrameContext& frame) const {
    const Transparency transparency = transparencyOf(plan());
    if (transparency != Transparency::kPeeled) { // which only loads solid depth
        handDepthOver(frame);
    }
    switch (transparency) {
    case Transparency::kSorted:
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) { recordSorted(at, part); });
        break;
    case Transparency::kWeighted:
        inParts(frame, frame.drawn(), cost(frame.costs), recordWeighted);
        nextRasterPass(frame.slot.cmd);
        break;
    case Transparency::kPeeled:
        recordPeeled(frame);
        break;
    }
    if (apart() && (transparency != Transparency::kPeeled || layer_count_ > 0)) {
        recordResolve(frame);
    }
}

void Blended::recordSorted(const FrameContext& frame, const vk::Rect2D& part) const {
    const auto pass = GeometryPass::kTransparent;
    inGroups(frame, pass, frame.draws.transparent.groups, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransparent);
        const auto& sums = overUnlit() ? targetsOf(frame).sums : frame.slot.targets->radiance;
        const auto load = overUnlit() && first ? LoadOp::eClear : LoadOp::eLoad;
        const std::array colors = {attachment(sums, load, nothing())};
        const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
        const Rendering rendering(frame, part, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

void Blended::recordPeeled(const FrameContext& frame) const {
    for (uint32_t layer = 0; layer < layer_count_; ++layer) {
        inParts(frame, frame.drawn(), cost(frame.costs),
                [layer](const FrameContext& at, const vk::Rect2D& part) {
                    const gpu::PassScope scope(at.slot.timestamps, at.slot.cmd, pass::kPeel);
                    recordPeelSelect(at, part, layer);
                    nextRasterPass(at.slot.cmd);
                    recordPeelShade(at, part, layer);
                    nextRasterPass(at.slot.cmd);
                });
    }
    if (counts_overflow_) {
        frame.slot.stored.get<PeelOverflow>().counter.restart();
        inParts(frame, frame.drawn(), cost(frame.costs),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    recordPeelCount(at, part, layer_count_);
                });
    }
}

void Blended::recordResolve(const FrameContext& frame) const {
    if (!overUnlit()) {
        inParts(frame, frame.drawn(), frame.costs.screen(),
                [this](const FrameContext& at, const vk::Rect2D& part) {
                    recordResolvePart(at, part);
                });
        return;
    }
    // blended sums, solid radiance -> loads and stores of a compute pass
    barrier(frame.slot.cmd, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
            Stage::eComputeShader, Access::eShaderSampledRead | use::kLoadStore);
    inParts(
        frame, frame.drawn(), frame.costs.screen(),
        [this](const FrameContext& at, const vk::Rect2D& part) { recordOverUnlitPart(at, part); });
}

void Blended::recordResolvePart(const FrameContext& frame, const vk::Rect2D& part) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBlendResolve);
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.pipelines;
    const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
    const Rendering rendering(frame, part, colors, nullptr);
    cmd.bindPipeline(vk::PipelineBindPoint::eGraphics,
                     pipelines.blendResolve(transparencyOf(plan())));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines.blendResolveLayout(), 0,
                           targetsOf(frame).resolveSet(), {});
    cmd.setCullMode(vk::CullModeFlagBits::eNone);
    cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    cmd.draw(3, 1, 0, 0);
}

void Blended::recordOverUnlitPart(const FrameContext& frame, const vk::Rect2D& part) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBlendOverUnlit);
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.pipelines;
    cmd.bindPipeline(
        vk::PipelineBindPoint::eCompute,
        pipelines.blendOverUnlit(transparencyOf(plan()), frame.plan.tone_output_flags));
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                             targetsOf(frame).resolveSet()};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.blendOverUnlitLayout(), 0,
                           sets, {});
    dispatchOver(cmd, part);
}

std::optional<StepPlan> planOfBlended(const PlanInputs& inputs) {
    if (!inputs.facts.transparent_visible) {
        return {};
    }
    const Transparency transparency = inputs.settings.transparency;
    return StepPlan{.way = (inputs.facts.unlit_solid ? kOverUnlit : 0U) |
                           (transparency == Transparency::kWeighted ? kWeighted : 0U) |
                           (transparency == Transparency::kPeeled ? kPeeled : 0U),
                    .count =
                        transparency == Transparency::kPeeled ? inputs.settings.peel_layers : 0};
}

// tested: as the rasteriser's depth.
std::vector<Use> usesOfBlending(const FramePlan& frame, bool tested) {
    std::vector uses =
        withLights({use::vertices(), use::depthTested(),
                    use::sampled(Resource::kDepth, Stage::eFragmentShader),
                    use::sampled(Resource::kTransmissiveDepth, Stage::eFragmentShader),
                    use::drawn(Resource::kRadiance)},
                   Stage::eFragmentShader);
    if (frame.geometry == SolidGeometry::kComputeIds && tested) {
        uses.push_back(use::copied(Resource::kDepth));
        uses.push_back(
            {Resource::kWords, Stage::eCopy, Access::eTransferRead | Access::eTransferWrite});
    }
    return uses;
}

std::vector<Use> usesOfBlended(const FramePlan& frame, const StepPlan& plan) {
    std::vector uses = usesOfBlending(frame, (plan.way & kPeeled) == 0);
    if ((plan.way & kOverUnlit) != 0) {
        uses.push_back(use::stored(Resource::kRadiance));
    }
    return uses;
}

std::string wordsOfBlended(const PlanInputs& inputs, const StepPlan* plan) {
    if (settings::replacesPicture(inputs.plan.debug)) {
        return {};
    }
    if (plan == nullptr) {
        return "no transparent surface in view: no sort, no blend pass";
    }
    const std::string over =
        (plan->way & kOverUnlit) != 0
            ? "; a separate pass blends them over unlit surfaces in display colours"
            : "";
    switch (transparencyOf(*plan)) {
    case Transparency::kWeighted:
        return "transparent surfaces in view: summed at once, weighted by distance, approximate" +
               over;
    case Transparency::kPeeled:
        return "transparent surfaces in view: up to " + std::to_string(plan->count) +
               " layers peeled from the eye, one layer of each pixel at a time" + over;
    case Transparency::kSorted:
        break;
    }
    return "transparent surfaces in view: sorted and blended" + over;
}

} // namespace

const StepRow kBlendedBehindStep{
    .name = pass::kTransparentBehind,
    .part = StepPart::kPicture,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.transparent_visible && inputs.facts.transmissive_visible
                       ? std::optional(StepPlan{})
                       : std::nullopt;
        },
    .uses = [](const FramePlan& frame, const StepPlan&) { return usesOfBlending(frame, true); },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr ? "transparent surfaces behind others that transmit "
                                                 "light: blended before these"
                                               : "");
        },
    .make = makeStep<BlendedBehind>};

const StepRow kBlendedStep{.name = pass::kTransparent,
                           .part = StepPart::kPicture,
                           .plan = planOfBlended,
                           .uses = usesOfBlended,
                           .words = wordsOfBlended,
                           .make = makeStep<Blended>,
                           .stats = kPeelStats};

} // namespace froxel::render
