// The host's part of a frame: what is drawn, which lights there are, which lists they make.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/light_assigner.h"
#include "interface/frame_io.h"
#include "light/frame_lights.h"
#include "render/draw_list.h"
#include "render/frame_plan.h"
#include "render/frame_recorder.h"
#include "render/frame_slot.h"
#include "render/renderer.h"
#include "render/scene_resources.h"

namespace froxel::render {

// Keep one a viewer and build into it again: its buffers are reused.
class FrameBuilder {
  public:
    explicit FrameBuilder(SceneResources& scene) : scene_(scene) {}

    // Culls, evaluates lights, plans, assigns lights to clusters.
    [[nodiscard]] FramePlan build(const FrameInputs& inputs);
    // Puts what build() made into the slot's buffer and describes it to the shaders.
    [[nodiscard]] UploadOffsets upload(FrameSlot& slot);

    [[nodiscard]] const DrawList& draws() const { return draws_; }
    // What the last plan was made from.
    [[nodiscard]] const FrameFacts& plannedFacts() const { return planned_; }
    [[nodiscard]] const LightListStats& listStats() const { return lists_.stats; }
    [[nodiscard]] glm::vec3 background() const { return uniforms_.background; }

  private:
    // Where a binding's data lies in the upload buffer.
    struct Block {
        vk::DeviceSize offset = 0;
        vk::DeviceSize bytes = 0;
    };
    using Blocks = std::array<Block, Pipelines::kFrameBindings>;

    // Fills grid and lists, or empties them.
    void assignLights(const view::ViewSettings& settings, bool lists);
    [[nodiscard]] FrameFacts facts(const FrameInputs& inputs) const;
    void writeFrameSet(FrameSlot& slot, const Blocks& blocks) const;

    SceneResources& scene_;
    light::FrameLights lights_;
    cluster::ClusterGrid grid_;
    cluster::LightLists lists_;
    DrawList draws_;
    FrameFacts planned_;
    io::Frame uniforms_{};
};

} // namespace froxel::render
