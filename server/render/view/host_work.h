// The host's part of a frame: what is drawn, which lights there are, which lists they make, and
// with these the frame's plan, its costs and its uploads.
#pragma once

#include "interface/frame_io.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/frame_costs.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_plan.h"
#include "render/frame/frame_slot.h"
#include "render/frame/frame_uniforms.h"
#include "render/frame/step.h"
#include "render/scene/scene_resources.h"
#include "render/view/culling.h"
#include "render/view/light_work.h"

#include <optional>
#include <span>

namespace froxel::render {

class ViewSteps;

// Keep one a viewer and build into it again: its buffers are reused.
class HostWork {
  public:
    HostWork(SceneResources& scene, const ListLimits& limits)
        : scene_(scene), pose_(scene), light_work_(scene, limits), culling_(scene) {}

    // Culls, evaluates lights, assigns them to clusters, lets steps look, plans: a stage at a time,
    // so that whoever shares the thread waits for one of them at most. Starting anew forgets what
    // was not taken. in_parts: stages that go through lists end after a tenth of a second.
    void start(const FrameInputs& inputs, bool in_parts);
    // Whether it was started for these and not taken.
    [[nodiscard]] bool builds(const FrameInputs& inputs) const {
        return stage_ && inputs_ == inputs;
    }
    // built() is false.
    void advance(ViewSteps& steps);
    [[nodiscard]] bool built() const { return stage_ == Stage::kBuilt; }
    // Waits for what runs beside the stages.
    void settle() const { culling_.settle(); }
    // built() is true; the next frame is to be started.
    [[nodiscard]] FramePlan take();
    // What the frame that was built takes. Where its lists are made on the device and could make it
    // longer than `piece`, the device looks at them before it shades, and leaves the frame without
    // lights where they hold more than is known: see LightWork::accept(). Refers to `steps` and
    // this.
    [[nodiscard]] FrameCosts costs(const FramePlan& plan,
                                   const FrameSize& size,
                                   std::span<const ActiveStep> steps,
                                   const UnitCosts& unit,
                                   const WorkLimits& work);
    // Adds what was built and steps have to what will be uploaded; nothing is allocated yet.
    void gather(FrameUpload& upload, std::span<const ActiveStep> steps);
    // Puts it into the slot's buffer, prepares steps and describes all of it to the shaders. Throws
    // vk::SystemError.
    void upload(FrameSlot& slot, std::span<const ActiveStep> steps);
    // Kept on the host for the next frame, for what grows with the number of lights, and where the
    // scene moves with its size.
    [[nodiscard]] uint64_t hostBytes() const { return light_work_.hostBytes() + pose_.hostBytes(); }

    [[nodiscard]] LightWork& lightWork() { return light_work_; }
    [[nodiscard]] const LightWork& lightWork() const { return light_work_; }
    [[nodiscard]] const ScenePose& pose() const { return pose_; }
    [[nodiscard]] const DrawList& draws() const { return culling_.draws(); }
    // What steps are told of the frame that was built.
    [[nodiscard]] StepInputs stepInputs() const {
        return {.settings = inputs_.settings,
                .size = frameSizeOfDrawn(inputs_.settings),
                .pose = pose_,
                .lights = light_work_.lights(),
                .draws = culling_.draws(),
                .debug = debug_,
                .form = inputs_.form,
                .time_s = inputs_.time_s,
                .keeps = inputs_.keep_surfaces};
    }
    // What solid surfaces of the frame with that plan are drawn from.
    [[nodiscard]] SurfacesDrawn surfaces(const FramePlan& plan) const {
        return {uniforms_.camera, culling_.number(), plan};
    }
    // What the last plan was made from.
    [[nodiscard]] const FrameFacts& plannedFacts() const { return planned_; }
    // Of a frame with a debug view.
    [[nodiscard]] const DebugFrame& debugFrame() const { return debug_; }

  private:
    enum class Stage : uint8_t { kLights, kPlan, kBuilt }; // what comes next

    [[nodiscard]] FramePlan plan(ViewSteps& steps);
    [[nodiscard]] FrameFacts facts() const;
    [[nodiscard]] uint32_t lightFacts() const;
    [[nodiscard]] bool prepassPays() const;
    [[nodiscard]] bool layersVisible() const; // of solid surfaces
    [[nodiscard]] bool transmissiveByIds() const;
    void buildUniforms(const FramePlan& plan);
    void buildDebug(const FramePlan& plan);

    SceneResources& scene_;
    ScenePose pose_;
    FrameInputs inputs_;         // of what is built
    std::optional<Stage> stage_; // none: nothing is
    FramePlan plan_;
    ViewProjection projection_;
    double farthest_m_ = 0;
    FrameFacts planned_;
    io::Frame uniforms_{};
    DebugFrame debug_;
    FrameBlocks blocks_; // of what was gathered, like the offsets
    UploadOffsets offsets_;
    LightWork light_work_;
    Culling culling_; // ends before what it reads
};

} // namespace froxel::render
