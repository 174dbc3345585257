// The nodes of a scene at a time: clips sampled, blended and carried down the tree.
#pragma once

#include "motion/affine.h"
#include "motion/clip_clock.h"
#include "scene/motion.h"
#include "scene/transform.h"

#include <span>
#include <vector>

namespace froxel::motion {

struct PlayedClip {
    uint32_t clip = 0; // of Motion::clips; scene::kNone: the rest pose
    ClipClock clock;
    Fade fade;
    bool covers = false; // what it weighs is taken from all clips before it

    bool operator==(const PlayedClip&) const = default;
};

struct Pose {
    std::vector<glm::dmat4> world_from_node; // one for each of Motion::nodes
    std::vector<double> weights;             // of morph targets, as Motion::rest_weights
};

// What plays where nobody chose: Motion::played, again and again from time 0.
[[nodiscard]] std::vector<PlayedClip> usualClips(const scene::Motion& motion);

// That one among Motion::clips, from 1; 0: none plays.
[[nodiscard]] uint32_t usualAnimation(const scene::Motion& motion);

// A pure function: the same bytes whatever was asked before. Each property is the sum of the clips
// that move it, in the order of `clips`, by their weights (those of their fades, less what later
// ones cover); what these lack of 1 is the rest pose's
// share, and what is beyond 1 is divided out. Rotations are summed in the first's hemisphere, the
// rest pose last, and made unit. Replaces the contents of `out`, whose memory is reused.
void pose(const scene::Motion& motion, std::span<const PlayedClip> clips, double time_s, Pose& out);

// Calls visit(index of Scene::lights, position, direction) for the lights that nodes move, all
// finite and the direction unit. A light whose node has none, or leaves the range of numbers, is
// left where it was.
template <class Visit>
void eachMovedLight(const scene::Motion& motion, const Pose& pose, const Visit& visit) {
    for (const scene::MovedThing& moved : motion.lights) {
        const glm::dmat4& world_from_node = pose.world_from_node[moved.node];
        const auto axes = axesOf(world_from_node);
        if (axes && scene::isUsable(world_from_node)) {
            visit(moved.index, glm::dvec3(world_from_node[3]), -(*axes)[2]);
        }
    }
}

} // namespace froxel::motion
