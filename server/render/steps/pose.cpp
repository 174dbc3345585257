// Vertices that bend, posed in compute, once for all passes of the frame.
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/posed_targets.h"
#include "render/frame/step.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"

#include <algorithm>
#include <utility>

namespace froxel::render {

namespace {

class Pose final : public Step {
  public:
    explicit Pose(SceneResources& scene) : scene_(scene) {}

    [[nodiscard]] bool holds() const override {
        return keeps_ && targets_ && !targets_->fresh && targets_->vertices.pose == pose_->number();
    }
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kPose, timeOf(costs)});
    }
    void addMemory(NeedList& need) const override {
        need.buffer("posed vertices", PosedVertices::bytes(scene_));
    }
    void gather(FrameUpload& upload, FrameBlocks& /*blocks*/) override {
        joints_offset_ = upload.add(pose_->joints());
        weights_offset_ = upload.add(pose_->weights());
    }
    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override;
    void record(const FrameContext& frame) const override;

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        pose_ = &inputs.pose;
        keeps_ = inputs.keeps;
        return {};
    }
    [[nodiscard]] Seconds timeOf(const FrameCosts& costs) const {
        return Seconds(static_cast<double>(scene_.poser()->vertex_count) *
                       costs.unit().posed_vertex);
    }

    SceneResources& scene_;
    const ScenePose* pose_ = nullptr; // the view's own
    bool keeps_ = false;
    vk::DeviceSize joints_offset_ = 0;
    vk::DeviceSize weights_offset_ = 0;
    std::shared_ptr<PosedTargets> targets_; // null: no frame yet
};

void Pose::prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) {
    if (!targets_) {
        targets_ = std::make_shared<PosedTargets>(scene_);
    }
    slot.step_targets.hold(targets_);
    const auto part = [&](vk::DeviceSize offset, size_t bytes) {
        // Where there are none, of what nothing reads.
        return vk::DescriptorBufferInfo{slot.upload.buffer(), offset, std::max<size_t>(bytes, 16)};
    };
    slot.stored.findOrMake<PoseSet>(scene_.shared.device, *scene_.poser())
        .write(scene_, *scene_.poser(), targets_->vertices,
               part(joints_offset_, pose_->joints().size_bytes()),
               part(weights_offset_, pose_->weights().size_bytes()));
}

void Pose::record(const FrameContext& frame) const {
    const auto& cmd = frame.slot.cmd;
    frame.pieces.add(timeOf(frame.costs));
    if (std::exchange(targets_->vertices.fresh, false)) {
        targets_->vertices.recordRest(cmd, scene_);
        computeAfterTransfer(cmd); // vertices at rest
    }
    const MeshPoser& poser = *scene_.poser();
    const vk::DescriptorSet set = frame.slot.stored.get<PoseSet>().set();
    {
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kPose);
        poser.recordVertices(cmd, set);
    }
    if (poser.flat) {
        nextComputePass(cmd); // positions, normals -> normals of moved triangles
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kPose);
        poser.recordFlatNormals(cmd, set);
    }
    targets_->vertices.pose = pose_->number();
}

} // namespace

const StepRow kPoseStep{
    .name = pass::kPose,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.bends ? std::optional(StepPlan{}) : std::nullopt;
        },
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector<Use>{{Resource::kPosed,
                                     use::Stage::eCopy | use::Stage::eComputeShader,
                                     use::Access::eTransferWrite | use::kLoadStore}};
        },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(
                plan != nullptr ? "skins or morph targets: vertices are posed in compute" : "");
        },
    .make = makeStep<Pose>};

} // namespace froxel::render
