// The host's part of a frame: what is drawn, which lights there are, which lists they make.
#pragma once

#include "cluster/light_assigner.h"
#include "cluster/list_cap.h"
#include "interface/frame_io.h"
#include "light/frame_lights.h"
#include "render/frame/draw_list.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/frame_context.h"
#include "render/frame/frame_costs.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_plan.h"
#include "render/frame/frame_slot.h"
#include "render/frame/frame_uniforms.h"
#include "render/lists/gpu_light_lists.h"
#include "render/lists/light_grid.h"
#include "render/scene/scene_resources.h"

#include <future>
#include <optional>
#include <span>

namespace froxel::render {

class ViewSteps;

// Keep one a viewer and build into it again: its buffers are reused.
class HostWork {
  public:
    HostWork(SceneResources& scene, const ListLimits& limits)
        : scene_(scene), pose_(scene), device_lists_(scene.shared.device, limits) {}

    // Culls, evaluates lights, assigns them to clusters, lets steps look, plans: a stage at a
    // time, so that whoever shares the thread waits for one of them at most. Starting anew forgets
    // what was not taken. in_parts: stages that go through lists end after a tenth of a second.
    void start(const FrameInputs& inputs, bool in_parts);
    // Whether it was started for these and not taken.
    [[nodiscard]] bool builds(const FrameInputs& inputs) const {
        return stage_ && inputs_ == inputs;
    }
    // built() is false.
    void advance(ViewSteps& steps);
    [[nodiscard]] bool built() const { return stage_ == Stage::kBuilt; }
    // Waits for what runs beside the stages.
    void settle() const;
    // built() is true; the next frame is to be started.
    [[nodiscard]] FramePlan take();
    // What the frame that was built takes. Where its lists are made on the device and could make it
    // longer than `piece`, the device looks at them before it shades, and leaves the frame without
    // lights where they hold more than is known: see acceptLists(). Refers to `plan`, `steps`
    // and this.
    [[nodiscard]] FrameCosts costs(const FramePlan& plan,
                                   const settings::Size& shown,
                                   std::span<const ActiveStep> steps,
                                   const UnitCosts& unit,
                                   const WorkLimits& work);
    // After a frame with lists from the device: whether they are whole. If not, the frame must be
    // built again, for which there will be room, and what its lists hold is known.
    [[nodiscard]] bool acceptLists(const AssignSlot& lists);
    // What lists held is of no use any more: the frame was refused, and another one comes.
    void forgetLists() { seen_lists_.reset(); }
    // Adds what was built and steps have to what will be uploaded; nothing is allocated yet.
    void gather(FrameUpload& upload, std::span<const ActiveStep> steps);
    // Puts it into the slot's buffer, prepares steps and describes all of it to the shaders. Throws
    // vk::SystemError.
    void upload(FrameSlot& slot, std::span<const ActiveStep> steps);
    // Of what was built: light lists on the device; none: the host made them, or there are none.
    [[nodiscard]] ListCapacity listCapacity() const;
    // Kept on the host for the next frame, for what grows with the number of lights, and where the
    // scene moves with its size.
    [[nodiscard]] uint64_t hostBytes() const;
    // Frees that.
    void letGo();

    [[nodiscard]] const ScenePose& pose() const { return pose_; }
    // What steps are told of the frame that was built.
    [[nodiscard]] StepInputs stepInputs() const {
        return {inputs_.settings,     pose_, lights_, draws_, debug_, inputs_.time_s,
                inputs_.keep_surfaces};
    }
    [[nodiscard]] const DrawList& draws() const { return draws_; }
    [[nodiscard]] const light::FrameLights& lights() const { return lights_; }
    // What solid surfaces of the frame with that plan are drawn from.
    [[nodiscard]] SurfacesDrawn surfaces(const FramePlan& plan) const {
        return {uniforms_.camera, draw_list_number_, plan};
    }
    // Point and spot lights of the frame.
    [[nodiscard]] uint32_t localLightCount() const {
        return static_cast<uint32_t>(lights_.lights.size());
    }
    // What the last plan was made from.
    [[nodiscard]] const FrameFacts& plannedFacts() const { return planned_; }
    // Of a frame with a debug view.
    [[nodiscard]] const DebugFrame& debugFrame() const { return debug_; }
    [[nodiscard]] const LightListStats& listStats() const { return lists_.stats; }
    [[nodiscard]] GridStats gridStats() const { return light_grid_.stats(); }

  private:
    enum class Stage : uint8_t { kLights, kGrid, kLists, kCap, kPlan, kBuilt }; // what comes next
    // The longest list of each tile, as the device last told.
    struct SeenLists {
        settings::GridSize grid;
        bool too_long = false; // for what they were held against
        std::vector<uint32_t> tile_longest;
        uint32_t all_lights = 0; // what each pixel loops over instead; 0: lists
    };
    // What is known of pairs before the device has made lists.
    [[nodiscard]] PairBound knownPairs(const FramePlan& plan) const;
    [[nodiscard]] std::optional<PairBound> seenPairs() const;
    // Tells the device what to hold its lists against, since nobody knows them yet, and the frame's
    // load what they come to at most; `costs` are by what is known.
    void limitLists(const FrameCosts& costs, const WorkLimits& work, CostInputs& load);
    [[nodiscard]] const cluster::GridCosts& gridCosts(const settings::ViewSettings& settings) const;
    void startCulling();
    // Whether the frame's lights are all there.
    [[nodiscard]] bool evaluateMore();
    void beginLights();
    void chooseGrid();
    [[nodiscard]] uint64_t entriesOfAStage() const;
    // Fills the lists, or empties them: whether they are whole.
    [[nodiscard]] bool assignMore();
    [[nodiscard]] bool capsLists() const;
    // Whether all are capped.
    [[nodiscard]] bool capMore();
    [[nodiscard]] FramePlan plan(ViewSteps& steps);
    // What pixels loop over.
    [[nodiscard]] const light::FrameLights& reach() const;
    [[nodiscard]] bool assignsOnDevice(const FrameInputs& inputs);
    // Where the device's assignment finds its data.
    [[nodiscard]] AssignOffsets gatherAssignment(FrameUpload& upload) const;
    void writeAssignment(FrameSlot& slot);
    [[nodiscard]] bool choosesVisibility(const FrameInputs& inputs);
    [[nodiscard]] bool choosesComputeRaster(const FrameInputs& inputs);
    [[nodiscard]] bool prepass(const FrameInputs& inputs) const;
    [[nodiscard]] bool layersVisible() const; // of solid surfaces
    [[nodiscard]] FrameFacts facts(const FrameInputs& inputs) const;
    // The cluster grid that cluster_wires shows, as lines.
    [[nodiscard]] std::vector<io::WireVertex> buildWires(const FrameInputs& inputs,
                                                         uint32_t& slice_count);
    void buildDebug(const FrameInputs& inputs, const FramePlan& plan, double farthest_m);

    SceneResources& scene_;
    ScenePose pose_;
    FrameInputs inputs_;                                    // of what is built
    std::optional<light::LightRig::Evaluation> evaluation_; // begun
    bool in_parts_ = false;
    std::optional<Stage> stage_;          // none: nothing is
    std::optional<cluster::ListCap> cap_; // under way
    FramePlan plan_;
    ViewProjection projection_;
    double farthest_m_ = 0;
    light::FrameLights lights_;
    light::FrameLights grown_; // as lights_, for positions in halves
    LightGrid light_grid_;
    cluster::LightLists lists_;                          // made by the host
    std::optional<cluster::LightAssignment> assignment_; // of them, under way
    GpuLightLists device_lists_;
    bool on_device_ = false;
    std::optional<SeenLists> seen_lists_;
    settings::ViewSettings refused_; // what the device's lists were too small for
    DrawList draws_;
    // What buildDrawList() and what goes with it are told, besides the scene.
    struct Culled {
        settings::Camera camera;
        settings::Size size;
        uint64_t pose = 0;
        bool visibility = false;
        TransparentOrder order = TransparentOrder::kByDistance;
        bool operator==(const Culled&) const = default;
    };
    std::optional<Culled> culled_; // what draws_ is of; none: of nothing whole
    Culled culls_;                 // what it will be of
    uint64_t draw_list_number_ = 0;
    std::vector<vk::DrawIndexedIndirectCommand>
        placed_commands_; // of draws_, for what was gathered
    settings::Size drawn_;
    FrameFacts planned_;
    bool visibility_ = false;
    bool compute_raster_ = false;
    std::vector<io::InstanceView> instances_; // for the visibility passes
    std::vector<uint32_t> meshlet_order_;
    io::Frame uniforms_{};
    FrameBlocks blocks_; // of what was gathered, like the offsets
    UploadOffsets offsets_;
    AssignOffsets assign_offsets_;
    DebugFrame debug_;
    LightGrid wire_grid_;            // of a frozen camera
    light::FrameLights wire_lights_; // as it sees them
    std::future<void> culling_;      // ends before what it writes to
};

} // namespace froxel::render
