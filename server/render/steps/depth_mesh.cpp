// A mesh over the picture with the depth of its solid surfaces, for viewers who draw the picture
// from the camera of now.
#include "core/depth_mesh.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/depth_mesh_io.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/pipelines/storage_set.h"
#include "render/steps/order.h"

#include <array>

namespace froxel::render {

namespace {

// Shared by every view.
struct DepthMeshPipeline {
    explicit DepthMeshPipeline(const DeviceResources& shared)
        : set_layout(storageLayout(shared.device, 1)),
          layout(gpu::makePipelineLayout(
              shared.device,
              {shared.pipelines.frameLayout(), shared.pipelines.screenLayout(), *set_layout},
              sizeof(io::DepthMeshFrame))),
          pipeline(gpu::makeComputePipeline(
              shared.device, shaders::depth_mesh_comp(), {}, *layout, pass::kDepthMesh)) {}

    vk::raii::DescriptorSetLayout set_layout;
    vk::raii::PipelineLayout layout;
    SharedPipeline pipeline;
};

// One a frame slot.
struct DepthMeshSet : StorageSet {
    DepthMeshSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : StorageSet(device, layout, 1) {}
};

// Writes where the host reads.
class DepthMesh final : public Step {
  public:
    explicit DepthMesh(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kDepthMesh, timeOf(costs)});
    }
    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        const auto& shared = scene_.shared.stored<DepthMeshPipeline>();
        const gpu::Buffer& vertices = slot.readback->output(Output::kDepthMesh);
        slot.stored.findOrMake<DepthMeshSet>(scene_.shared.device, *shared.set_layout)
            .write(std::array{vk::DescriptorBufferInfo{*vertices.handle, 0, VK_WHOLE_SIZE}});
    }
    void record(const FrameContext& frame) const override;

  private:
    // A vertex reads about a fifth of its cell's pixels.
    [[nodiscard]] static Seconds timeOf(const FrameCosts& costs) {
        const settings::Size& size = costs.load().size.shown;
        return Seconds(DepthMeshSize(size.width_px, size.height_px).vertexCount() *
                       costs.unit().screen_pixel);
    }

    SceneResources& scene_;
};

void DepthMesh::record(const FrameContext& frame) const {
    frame.pieces.add(timeOf(frame.costs));
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kDepthMesh);
    auto& shared = scene_.shared.stored<DepthMeshPipeline>();
    shared.pipeline.bind(cmd, scene_.shared.variants);
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                             frame.slot.stored.get<DepthMeshSet>().handle()};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *shared.layout, 0, sets, {});
    const settings::Size& shown = frame.shown();
    const DepthMeshSize mesh(shown.width_px, shown.height_px);
    cmd.pushConstants<io::DepthMeshFrame>(
        *shared.layout, vk::ShaderStageFlagBits::eCompute, 0,
        io::DepthMeshFrame{.columns = mesh.columns,
                           .rows = mesh.rows,
                           .cell_px = kDepthCell_px,
                           .samples = frame.drawn().width_px / shown.width_px});
    dispatchOver(cmd, {{0, 0}, {mesh.columns, mesh.rows}});
}

} // namespace

const StepRow kDepthMeshStep{
    .name = pass::kDepthMesh,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.outputs.has(Output::kDepthMesh) ? std::optional(StepPlan{})
                                                                : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::sampled(Resource::kDepth)}; },
    .make = makeStep<DepthMesh>};

} // namespace froxel::render
