#include "motion/player.h"

#include "motion/affine.h"
#include "scene/transform.h"

#include <algorithm>
#include <iterator>

namespace froxel::motion {

namespace {

// Poses that framing looks at, of all clips together.
constexpr size_t kFramedPoses = 64;
constexpr size_t kFramedPosesOfClip = 16;

BoundsD3 boxOf(const scene::Mesh& mesh) {
    BoundsD3 box;
    for (const scene::Primitive& primitive : mesh.primitives) {
        box.add(BoundsD3{primitive.bounds.min, primitive.bounds.max});
    }
    return box;
}

} // namespace

Player::Player(const scene::Scene& scene)
    : motion_(scene.motion), deformed_of_mesh_(scene.meshes.size(), scene::kNone) {
    std::transform(scene.meshes.begin(), scene.meshes.end(), std::back_inserter(boxes_), boxOf);
    std::vector<bool> moves(scene.instances.size());
    for (const scene::MovedInstance& moved : motion_->instances) {
        moves[moved.instance] = true;
    }
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        rest_instances_.push_back(instance.world_from_object);
        meshes_.push_back(instance.mesh);
        if (!moves[i]) {
            resting_world_.add(transformed(boxes_[instance.mesh], instance.world_from_object));
        }
    }
    for (size_t d = 0; d < motion_->deformed.size(); ++d) {
        const scene::DeformedMesh& mesh = motion_->deformed[d];
        deformed_of_mesh_[mesh.mesh] = static_cast<uint32_t>(d);
        primitives_.push_back(scene.meshes[mesh.mesh].primitives);
        auto& extents = extents_.emplace_back();
        for (size_t p = 0; p < primitives_[d].size(); ++p) {
            extents.push_back(extentOf(primitives_[d][p], mesh.deformations[p],
                                       motion_->nodes[mesh.node].weight_count));
        }
    }
}

std::span<const double> Player::weightsOf(const Moment& moment, size_t deformed) const {
    const scene::Node& node = motion_->nodes[motion_->deformed[deformed].node];
    return std::span(moment.pose.weights).subspan(node.first_weight, node.weight_count);
}

void Player::poseMeshes(Moment& out) const {
    out.skins.resize(motion_->deformed.size());
    out.deformed.assign(motion_->deformed.size(), {});
    for (size_t d = 0; d < motion_->deformed.size(); ++d) {
        const scene::DeformedMesh& mesh = motion_->deformed[d];
        const bool skinned = mesh.skin != scene::kNone;
        if (skinned) {
            poseSkin(motion_->skins[mesh.skin], out.pose, out.skins[d]);
        }
        for (const DeformExtent& extent : extents_[d]) {
            out.deformed[d].add(
                boundsOf(extent, weightsOf(out, d), skinned ? &out.skins[d] : nullptr));
        }
    }
}

void Player::at(std::span<const PlayedClip> clips, double time_s, Moment& out) const {
    pose(*motion_, clips, time_s, out.pose);
    poseMeshes(out);
    if (out.instances.size() != rest_instances_.size()) {
        out.instances = rest_instances_;
    }
    out.bounds_world = resting_world_;
    for (const scene::MovedInstance& moved : motion_->instances) {
        glm::dmat4& world_from_object = out.instances[moved.instance];
        if (moved.deformed != scene::kNone) {
            world_from_object = out.skins[moved.deformed].world_from_posed;
        } else {
            world_from_object = out.pose.world_from_node[moved.node] * moved.node_from_object;
        }
        if (!scene::isUsable(world_from_object)) {
            world_from_object = glm::dmat4(0);
            world_from_object[3].w = 1;
        }
        const uint32_t mesh = meshes_[moved.instance];
        const uint32_t deformed = deformed_of_mesh_[mesh];
        out.bounds_world.add(transformed(
            deformed == scene::kNone ? boxes_[mesh] : out.deformed[deformed], world_from_object));
    }
}

void Player::deformAt(const Moment& moment,
                      size_t deformed,
                      size_t primitive,
                      PosedVertices& out) const {
    const scene::DeformedMesh& mesh = motion_->deformed[deformed];
    const scene::Deformation& deformation = mesh.deformations[primitive];
    const bool skinned = !deformation.first_influence.empty();
    deform(primitives_[deformed][primitive], deformation, weightsOf(moment, deformed),
           skinned ? &moment.skins[deformed] : nullptr, out);
}

BoundsD3 boundsOverClips(const scene::Scene& scene) {
    const Player player(scene);
    const auto& clips = scene.motion->clips;
    Moment moment;
    player.at({}, 0, moment);
    BoundsD3 bounds = moment.bounds_world;
    const size_t poses =
        clips.empty() ? 0 : std::clamp<size_t>(kFramedPoses / clips.size(), 1, kFramedPosesOfClip);
    for (uint32_t c = 0; c < clips.size() && c < kFramedPoses; ++c) {
        const PlayedClip played{.clip = c, .clock = {.repeat = Repeat::kOnce}, .fade = {}};
        for (size_t i = 0; i < poses; ++i) {
            const double share = static_cast<double>(i + 1) / static_cast<double>(poses);
            player.at(std::span(&played, 1), share * clips[c].duration_s, moment);
            bounds.add(moment.bounds_world);
        }
    }
    return bounds;
}

} // namespace froxel::motion
