// What of the scene a frame draws: in which way, and what its camera may see of it.
#pragma once

#include "interface/visibility_io.h"
#include "render/frame/draw_list.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_slot.h"
#include "render/frame/frame_uniforms.h"

#include <cstdint>
#include <future>
#include <optional>
#include <vector>

namespace froxel::render {

// Keep one a viewer: its buffers are reused, and what the frame before drew, where nothing moved.
class Culling {
  public:
    explicit Culling(SceneResources& scene) : scene_(scene) {}

    // Chooses how solid surfaces are drawn, and begins. On a CPU device a thread of its own goes
    // on; the arguments stay as they are until finish().
    void start(const FrameInputs& inputs, const ScenePose& pose, const ViewProjection& projection);
    // Ends what was begun and not finished: before the arguments change.
    void abandon() { culling_ = {}; }
    // Waits for that thread.
    void settle() const;
    // What follows is about the frame that was begun.
    void finish();
    [[nodiscard]] SolidGeometry geometry() const { return geometry_; }
    [[nodiscard]] const DrawList& draws() const { return draws_; }
    // Of the draw list: another one, another number.
    [[nodiscard]] uint64_t number() const { return number_; }
    void gather(FrameUpload& upload, UploadOffsets& offsets);

  private:
    // What buildDrawList() and what goes with it are told, besides the scene.
    struct Culled {
        settings::Camera camera;
        settings::Size size;
        float geometry_error_px = 0;
        uint64_t pose = 0;
        bool by_ids = false;
        TransparentOrder order = TransparentOrder::kByDistance;
        bool operator==(const Culled&) const = default;
    };
    void build(const ScenePose& pose, const ViewProjection& projection);

    SceneResources& scene_;
    SolidGeometry geometry_ = SolidGeometry::kRaster;
    std::optional<Culled> culled_; // what draws_ is of; none: of nothing whole
    Culled culls_;                 // what it will be of
    uint64_t number_ = 0;
    DrawList draws_;
    std::vector<vk::DrawIndexedIndirectCommand> placed_commands_; // of draws_, as gathered
    std::vector<io::InstanceView> instances_;                     // where ids are drawn
    std::vector<uint32_t> meshlet_order_;
    std::future<void> culling_; // ends before what it writes to
};

} // namespace froxel::render
