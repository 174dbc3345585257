// A scene as it stands at a time: where its instances are, how its meshes are bent, what holds it.
#pragma once

#include "motion/bounds.h"
#include "motion/deform.h"
#include "motion/pose.h"
#include "motion/skin_pose.h"
#include "scene/motion.h"

#include <memory>
#include <span>
#include <vector>

namespace froxel::motion {

// Keep one for a player and fill it again: its buffers are reused.
struct Moment {
    Pose pose;
    std::vector<glm::dmat4> instances; // world_from_object, as Scene::instances
    std::vector<SkinPose> skins;       // one for each of Motion::deformed; empty without a skin
    std::vector<BoundsD3> deformed;    // of each of these: hold deform()'s positions
    BoundsD3 bounds_world;             // of all instances
};

// Immutable after construction: any number of threads may ask at once.
class Player {
  public:
    // Copies what it needs. The scene has motion.
    explicit Player(const scene::Scene& scene);

    // Replaces the contents of `out`. Pure: see pose(). An instance whose transform leaves the
    // range of numbers is a point at the origin.
    void at(std::span<const PlayedClip> clips, double time_s, Moment& out) const;

    // The primitive of a deformed mesh as it stands at a moment.
    void
    deformAt(const Moment& moment, size_t deformed, size_t primitive, PosedVertices& out) const;

    [[nodiscard]] const scene::Motion& motion() const { return *motion_; }

  private:
    [[nodiscard]] std::span<const double> weightsOf(const Moment& moment, size_t deformed) const;
    void poseMeshes(Moment& out) const;

    std::shared_ptr<const scene::Motion> motion_;
    std::vector<glm::dmat4> rest_instances_;
    BoundsD3 resting_world_;                 // of instances that no node moves
    std::vector<BoundsD3> boxes_;            // of each mesh, object space; of deformed ones empty
    std::vector<uint32_t> meshes_;           // of each instance
    std::vector<uint32_t> deformed_of_mesh_; // of Motion::deformed; kNone: rigid
    std::vector<std::vector<scene::Primitive>> primitives_; // of each deformed mesh
    std::vector<std::vector<DeformExtent>> extents_;        // likewise
};

// Holds the scene while any of its clips plays, and its rest pose: poses are sampled, so it is for
// framing, not for culling. The scene has motion.
[[nodiscard]] BoundsD3 boundsOverClips(const scene::Scene& scene);

} // namespace froxel::motion
