#include "render/frame/scene_pose.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace froxel::render {

static_assert(sizeof(io::PoseJoint) == sizeof(motion::JointMatrix));

ScenePose::ScenePose(SceneResources& scene)
    : scene_(scene), material_set_(scene.materialsOfVariant(0)) {
    if (scene.motion) {
        moved_ = std::unique_ptr<Moved>(new Moved{.playing = {},
                                                  .moment = {},
                                                  .items = material_set_->items,
                                                  .bounds_world = scene.bounds_world,
                                                  .light_rig = scene.light_rig,
                                                  .joints = {},
                                                  .weights = {}});
        standAt(0);
    }
}

namespace {

// Bit by bit.
template <class T>
bool equal(const std::vector<T>& a, const std::vector<T>& b) {
    return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

} // namespace

void ScenePose::placeItems() {
    const auto& deformed_of_instance = scene_.motion->deformed_of_instance;
    moved_->winds_as_at_start = true;
    for (size_t i = 0; i < moved_->items.size(); ++i) {
        DrawItem& item = moved_->items[i];
        item.mirrored = glm::determinant(glm::dmat3(moved_->moment.instances[item.instance])) < 0;
        moved_->winds_as_at_start &= item.mirrored == material_set_->items[i].mirrored;
        if (item.bends) {
            const BoundsD3& box = moved_->moment.deformed[deformed_of_instance[item.instance]];
            item.primitive.center = glm::vec3(box.center());
            // Half a diagonal, by the rounding of both to single precision more.
            const double reach = glm::length(box.size()) * 0.5 + glm::length(box.center()) * 1e-6;
            item.primitive.radius = static_cast<float>(reach * (1 + 1e-6));
        }
    }
}

void ScenePose::wear(uint32_t material_variant) {
    if (material_variant_ == material_variant) {
        return;
    }
    material_variant_ = material_variant;
    material_set_ = scene_.materialsOfVariant(material_variant);
    if (moved_) {
        moved_->items = material_set_->items;
        placeItems();
    }
    ++number_;
}

void ScenePose::standAt(double time_s, const std::optional<motion::Playing>& playing) {
    if (!moved_) {
        return;
    }
    const SceneMotion& shared = *scene_.motion;
    motion::Playing wanted = playing ? *playing : motion::Playing{shared.clips, time_s};
    if (moved_->playing == wanted) {
        return;
    }
    motion::Moment& moment = moved_->moment;
    const auto [instances, joints, weights] =
        std::tuple(moment.instances, moved_->joints, moved_->weights);
    shared.player.at(wanted.clips, wanted.now_s, moment);
    moved_->bounds_world = scene_.bounds_world;
    moved_->bounds_world.add(moment.bounds_world);
    if (!shared.player.motion().lights.empty()) {
        moved_->light_rig = scene_.light_rig; // whatever stood elsewhere before
        motion::eachMovedLight(shared.player.motion(), moment.pose,
                               [&](const auto&... light) { moved_->light_rig.place(light...); });
    }
    placeItems();
    if (shared.poser) {
        moved_->joints.clear();
        for (const motion::SkinPose& skin : moment.skins) {
            moved_->joints.insert(moved_->joints.end(), skin.joints.begin(), skin.joints.end());
        }
        moved_->weights.assign(moment.pose.weights.begin(), moment.pose.weights.end());
    }
    moved_->playing = std::move(wanted);
    // A clip that is paused goes on in time and stands still.
    number_ += equal(instances, moment.instances) && equal(joints, moved_->joints) &&
                       equal(weights, moved_->weights)
                   ? 0U
                   : 1U;
}

uint64_t ScenePose::hostBytes() const {
    const auto kept = [](const auto& elements) {
        return elements.capacity() * sizeof(elements[0]);
    };
    return moved_ ? kept(moved_->moment.instances) + kept(moved_->items) +
                        kept(moved_->moment.pose.world_from_node) + kept(moved_->joints)
                  : 0;
}

} // namespace froxel::render
