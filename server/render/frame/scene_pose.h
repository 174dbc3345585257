// Where all of a scene is in a frame, for what the host makes of one.
#pragma once

#include "motion/playback.h"
#include "render/scene/scene_resources.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace froxel::render {

// Each view has its own, so that views at different times are built side by side. One thread at a
// time changes it, any number may read. A scene that rests is read where it is: nothing is copied.
class ScenePose {
  public:
    explicit ScenePose(SceneResources& scene);

    // Shows the scene with that material variant's materials; see
    // SceneResources::materialsOfVariant(). Spans handed out before end.
    void wear(uint32_t material_variant);
    [[nodiscard]] const std::shared_ptr<MaterialSet>& materialSet() const { return material_set_; }

    // Stands where the clips have the scene then: a pure function of what plays. None: what
    // Motion::played says, at time_s. Spans handed out before end.
    void standAt(double time_s, const std::optional<motion::Playing>& playing = {});

    [[nodiscard]] std::span<const glm::dmat4> instances() const { // world_from_object
        return moved_ ? moved_->moment.instances : scene_.instances;
    }
    [[nodiscard]] std::span<const DrawItem> items() const {
        return moved_ ? moved_->items : material_set_->items;
    }
    [[nodiscard]] const BoundsD3& boundsWorld() const {
        return moved_ ? moved_->bounds_world : scene_.bounds_world;
    }
    [[nodiscard]] const light::LightRig& lightRig() const {
        return moved_ ? moved_->light_rig : scene_.light_rig;
    }
    // Whether all items are mirrored as MaterialSet::items are: the visibility passes' groups are
    // cut by that.
    [[nodiscard]] bool windsAsAtStart() const { return !moved_ || moved_->winds_as_at_start; }

    // What MeshPoser's vertices follow.
    [[nodiscard]] std::span<const motion::JointMatrix> joints() const {
        return moved_ ? moved_->joints : std::span<const motion::JointMatrix>();
    }
    [[nodiscard]] std::span<const float> weights() const {
        return moved_ ? moved_->weights : std::span<const float>();
    }
    // Counts changes of where surfaces are, and of their materials.
    [[nodiscard]] uint64_t number() const { return number_; }
    // Kept on the host, for what grows with the scene.
    [[nodiscard]] uint64_t hostBytes() const;

  private:
    struct Moved {
        std::optional<motion::Playing> playing;
        motion::Moment moment;
        std::vector<DrawItem> items;
        BoundsD3 bounds_world;
        light::LightRig light_rig;
        bool winds_as_at_start = true;
        std::vector<motion::JointMatrix> joints;
        std::vector<float> weights;
    };
    void placeItems();

    SceneResources& scene_;
    uint32_t material_variant_ = 0;
    std::shared_ptr<MaterialSet> material_set_;
    std::unique_ptr<Moved> moved_; // null: the scene rests
    uint64_t number_ = 0;
};

} // namespace froxel::render
