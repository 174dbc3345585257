// A debug view over the lit picture: lines in space, faint behind surfaces.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/debug_io.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/screen_pass.h"

#include <algorithm>
#include <array>
#include <string>

namespace froxel::render {

namespace {

gpu::GraphicsPipelineInfo wiresInfo(gpu::Spirv vertex, vk::PipelineLayout layout) {
    gpu::GraphicsPipelineInfo info;
    info.vertex = vertex;
    info.fragment = shaders::wire_frag();
    info.constants = {0, 0, 0, 1};
    info.layout = layout;
    info.color_formats = {Pipelines::kRadianceFormat};
    info.blend = gpu::Blend::kOver;
    info.lines = true;
    return info;
}

// Shared by every view. Made when first needed.
class WirePipelines {
  public:
    explicit WirePipelines(DeviceResources& shared)
        : device_(shared.device), layout_(shared.pipelines.screenPipelineLayout()),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    // Spheres around lights, else edges of clusters.
    [[nodiscard]] vk::Pipeline find(bool spheres) {
        return *made_.findOrMake(spheres, [=, this] { return make(spheres); });
    }

  private:
    [[nodiscard]] vk::raii::Pipeline make(bool spheres) const {
        auto info = wiresInfo(spheres ? shaders::light_wires_vert() : shaders::cluster_wires_vert(),
                              layout_);
        if (!spheres) {
            info.bindings = {{0, sizeof(io::WireVertex), vk::VertexInputRate::eVertex}};
            info.attributes = {{0, 0, vk::Format::eR32G32B32Sfloat, 0},
                               {1, 0, vk::Format::eR8G8B8A8Unorm, 12}};
        }
        return gpu::makeGraphicsPipeline(device_, info, spheres ? "light wires" : "cluster wires");
    }

    const gpu::Device& device_;
    vk::PipelineLayout layout_;
    VariantCache<bool> made_;
};

class Wires final : public Step {
  public:
    explicit Wires(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        if (lineCount() > 0) {
            passes.push_back({pass::kWires, static_cast<double>(lineCount()) * lineTime(costs)});
        }
    }
    void gather(FrameUpload& upload, FrameBlocks& /*blocks*/) override {
        if (!debug_->wires.empty()) {
            offset_ = upload.add(std::span<const io::WireVertex>(debug_->wires));
        }
    }
    void record(const FrameContext& frame) const override;

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override {
        spheres_ = frame.debug == settings::DebugView::kLightSpheres;
        debug_ = &inputs.debug;
        return {};
    }
    [[nodiscard]] uint64_t lineCount() const {
        return spheres_ ? uint64_t{debug_->light_count} * io::kLinesOfALight
                        : debug_->wires.size() / 2;
    }
    [[nodiscard]] Seconds lineTime(const FrameCosts& costs) const {
        return costs.lines(1, debug_->wire_px /
                                  static_cast<double>(std::max<uint64_t>(lineCount(), 1)));
    }
    // A light's spheres or a line each.
    void recordSome(const FrameContext& frame, uint32_t first, uint32_t count) const;

    bool spheres_ = false;
    const DebugFrame* debug_ = nullptr; // the view's own
    vk::DeviceSize offset_ = 0;
};

// Later lights' lines blend over those before.
void Wires::record(const FrameContext& frame) const {
    const uint32_t lines_each = spheres_ ? io::kLinesOfALight : 1;
    const auto total = static_cast<uint32_t>(lineCount() / lines_each);
    const Seconds each = lines_each * lineTime(frame.costs);
    const auto at_once = static_cast<uint32_t>(std::min<size_t>(frame.pieces.fits(each), total));
    for (uint32_t first = 0; first < total; first += at_once) {
        const uint32_t count = std::min(at_once, total - first);
        frame.pieces.add(count * each);
        recordSome(frame, first, count);
        nextRasterPass(frame.slot.cmd);
    }
}

void Wires::recordSome(const FrameContext& frame, uint32_t first, uint32_t count) const {
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kWires);
    const std::array colors = {
        attachment(frame.slot.targets->radiance, vk::AttachmentLoadOp::eLoad)};
    const auto& size = frame.drawn();
    const Rendering rendering(frame, {{0, 0}, {size.width_px, size.height_px}}, colors, nullptr);
    cmd.setCullMode(vk::CullModeFlagBits::eNone);
    cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    bindScreen(frame, vk::PipelineBindPoint::eGraphics,
               frame.scene.shared.stored<WirePipelines>().find(spheres_));
    if (spheres_) {
        cmd.draw(2 * io::kLinesOfALight, count, 0, first);
    } else {
        cmd.bindVertexBuffers(0, frame.slot.upload.buffer(), offset_);
        cmd.draw(2 * count, 1, 2 * first, 0);
    }
}

std::string wordsOfWires(const PlanInputs& inputs, const StepPlan* plan) {
    return plan != nullptr ? "debug view " + std::string(settings::nameOf(inputs.plan.debug)) +
                                 ": a separate pass draws lines over the picture"
                           : std::string();
}

} // namespace

const StepRow kWiresStep{
    .name = pass::kWires,
    .part = StepPart::kPicture,
    .plan =
        [](const PlanInputs& inputs) {
            return settings::isOverlay(inputs.plan.debug) ? std::optional(StepPlan{})
                                                          : std::nullopt;
        },
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kDepth, use::Stage::eFragmentShader),
                               use::drawn(Resource::kRadiance)};
        },
    .words = wordsOfWires,
    .make = makeStep<Wires>};

} // namespace froxel::render
