// The host's part of a frame's lights: where they are, and which lists they make.
#pragma once

#include "cluster/light_assigner.h"
#include "cluster/list_cap.h"
#include "interface/debug_io.h"
#include "light/frame_lights.h"
#include "light/light_rig.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/frame_costs.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_slot.h"
#include "render/frame/scene_pose.h"
#include "render/lists/gpu_light_lists.h"
#include "render/lists/light_grid.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace froxel::render {

// Keep one a viewer: its buffers are reused.
class LightWork {
  public:
    LightWork(SceneResources& scene, const ListLimits& limits)
        : scene_(scene), device_lists_(scene.shared.device, limits) {}

    // Begins a frame, whose inputs and pose stay as they are until it is drawn. in_parts: advance()
    // ends after a tenth of a second where it goes through lights or lists.
    void
    start(const FrameInputs& inputs, const ScenePose& pose, SolidGeometry geometry, bool in_parts);
    // The next stage: whether lights and lists are all there now.
    [[nodiscard]] bool advance();

    [[nodiscard]] const light::FrameLights& lights() const { return lights_; }
    [[nodiscard]] const LightGrid& grid() const { return grid_; }
    [[nodiscard]] const cluster::LightLists& lists() const { return lists_; } // made by the host
    [[nodiscard]] ListPlace place() const {
        return !grid_.lists() ? ListPlace::kNowhere
               : on_device_   ? ListPlace::kDevice
                              : ListPlace::kHost;
    }
    // Of lights that a pixel loops over, about.
    [[nodiscard]] double looped() const {
        return grid_.lists() ? grid_.listLength() : static_cast<double>(lights_.lights.size());
    }
    [[nodiscard]] LightListStats stats() const;
    // The cluster grid that cluster_wires shows, as lines: of a frozen camera, if there is one.
    [[nodiscard]] std::vector<io::WireVertex> wires(uint32_t& slice_count);

    // What is known of pairs before the device has made lists.
    [[nodiscard]] PairBound knownPairs(bool lists) const;
    // Tells the device what to hold its lists against, since nobody knows them yet, and the frame's
    // load what they come to at most; `costs` are by what is known.
    void limit(const FrameCosts& costs, const WorkLimits& work, CostInputs& load);
    // After a frame with lists from the device: whether they are whole. If not, the frame must be
    // built again, for which there will be room, and what its lists hold is known.
    [[nodiscard]] bool accept(const AssignSlot& lists);
    // What lists held is of no use any more.
    void forgetSeen() { seen_.reset(); }

    // Adds lights and lists to what will be uploaded.
    void gather(FrameUpload& upload, FrameBlocks& blocks);
    // Makes what the device's assignment lacks, and describes it. Throws vk::SystemError.
    void prepare(FrameSlot& slot, FrameBlocks& blocks);
    // Of lists on the device; none: the host made them, or there are none.
    [[nodiscard]] ListCapacity capacity() const;
    // Kept for the next frame, for what grows with the number of lights.
    [[nodiscard]] uint64_t hostBytes() const;
    // Frees that.
    void letGo();

  private:
    enum class Stage : uint8_t { kLights, kGrid, kLists, kCap, kDone }; // what comes next
    // The longest list of each tile, as the device last told.
    struct SeenLists {
        settings::GridSize grid;
        bool too_long = false; // for what they were held against
        std::vector<uint32_t> tile_longest;
        uint32_t all_lights = 0; // what each pixel loops over instead; 0: lists
    };
    // Each: whether it is done.
    [[nodiscard]] bool evaluateMore();
    [[nodiscard]] bool assignMore();
    [[nodiscard]] bool capMore();
    void chooseGrid();
    [[nodiscard]] uint64_t entriesOfAStage() const { return in_parts_ ? 2'000'000 : UINT64_MAX; }
    // What pixels loop over.
    [[nodiscard]] const light::FrameLights& reach() const;
    [[nodiscard]] const cluster::GridCosts& gridCosts() const;
    [[nodiscard]] bool assignsOnDevice();
    [[nodiscard]] std::optional<PairBound> seenPairs() const;

    SceneResources& scene_;
    const FrameInputs* inputs_ = nullptr; // of what is built
    const ScenePose* pose_ = nullptr;
    SolidGeometry geometry_ = SolidGeometry::kRaster;
    bool in_parts_ = false;
    Stage stage_ = Stage::kDone;
    std::optional<light::LightRig::Evaluation> evaluation_; // begun
    light::FrameLights lights_;
    light::FrameLights grown_; // as lights_, for positions in halves
    LightGrid grid_;
    cluster::LightLists lists_;
    std::optional<cluster::LightAssignment> assignment_; // of them, under way
    std::optional<cluster::ListCap> cap_;                // likewise
    GpuLightLists device_lists_;
    bool on_device_ = false;
    std::optional<SeenLists> seen_;
    settings::ViewSettings refused_; // what the device's lists were too small for
    AssignOffsets assign_offsets_;   // of what was gathered
    LightGrid wire_grid_;            // of a frozen camera
    light::FrameLights wire_lights_; // as it sees them
};

} // namespace froxel::render
