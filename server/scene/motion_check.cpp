#include "scene/motion_check.h"

#include <algorithm>
#include <cmath>

namespace froxel::scene {

namespace {

using Fault = std::optional<std::string>;

Fault beyond(const std::string& what, size_t index, size_t count) {
    return index < count
               ? Fault()
               : what + " is " + std::to_string(index) + "; there are " + std::to_string(count);
}

// Whether first says where each of `count` vertices has its part of `element_count`.
bool cuts(const std::vector<uint32_t>& first, size_t count, size_t element_count) {
    return first.empty() ||
           (first.size() == count + 1 && first.front() == 0 &&
            std::is_sorted(first.begin(), first.end()) && first.back() == element_count);
}

Fault faultIn(const Track& track) {
    const size_t parts = track.interpolation == Interpolation::kCubicSpline ? 3 : 1;
    const auto finite = [](float number) { return std::isfinite(number); };
    const bool right = !track.times_s.empty() &&
                       std::is_sorted(track.times_s.begin(), track.times_s.end()) &&
                       track.values.size() == track.times_s.size() * parts * track.width &&
                       std::all_of(track.times_s.begin(), track.times_s.end(), finite) &&
                       std::all_of(track.values.begin(), track.values.end(), finite);
    return right ? Fault() : "has a track without rising keys and a finite value for each";
}

Fault faultIn(const Channel& channel, const Clip& clip, const Motion& motion) {
    if (const Fault fault = beyond("a channel's track", channel.track, clip.tracks.size())) {
        return fault;
    }
    if (const Fault fault = beyond("a channel's node", channel.node, motion.nodes.size())) {
        return fault;
    }
    const Node& node = motion.nodes[channel.node];
    const uint32_t width = clip.tracks[channel.track].width;
    // Of a node that places nothing any width will do.
    const bool right = channel.path == ChannelPath::kWeights
                           ? node.weight_count == 0 || node.weight_count == width
                           : width == (channel.path == ChannelPath::kRotation ? 4U : 3U);
    return right ? Fault() : "a channel's track has a width of " + std::to_string(width);
}

Fault faultIn(const Clip& clip, const Motion& motion) {
    for (const Track& track : clip.tracks) {
        if (Fault fault = faultIn(track)) {
            return fault;
        }
    }
    for (const Channel& channel : clip.channels) {
        if (Fault fault = faultIn(channel, clip, motion)) {
            return fault;
        }
    }
    return {};
}

Fault faultIn(const Deformation& deformation,
              const Primitive& primitive,
              size_t joint_count,
              size_t target_count) {
    const size_t count = primitive.positions.size();
    if (!cuts(deformation.first_influence, count, deformation.influences.size()) ||
        !cuts(deformation.first_delta, count, deformation.deltas.size())) {
        return "influences or deltas are not divided among the vertices";
    }
    for (const Influence& influence : deformation.influences) {
        if (Fault fault = beyond("an influence's joint", influence.joint, joint_count)) {
            return fault;
        }
    }
    for (const MorphDelta& delta : deformation.deltas) {
        if (Fault fault = beyond("a delta's target", delta.target, target_count)) {
            return fault;
        }
    }
    return {};
}

Fault faultIn(const DeformedMesh& mesh, const Scene& scene) {
    const Motion& motion = *scene.motion;
    for (Fault fault :
         {beyond("mesh", mesh.mesh, scene.meshes.size()),
          beyond("node", mesh.node, motion.nodes.size()),
          mesh.skin == kNone ? Fault() : beyond("skin", mesh.skin, motion.skins.size())}) {
        if (fault) {
            return fault;
        }
    }
    const auto& primitives = scene.meshes[mesh.mesh].primitives;
    if (mesh.deformations.size() != primitives.size()) {
        return "deformations are " + std::to_string(mesh.deformations.size()) +
               "; expected one for each primitive";
    }
    const size_t joint_count = mesh.skin == kNone ? 0 : motion.skins[mesh.skin].joints.size();
    for (size_t p = 0; p < primitives.size(); ++p) {
        if (Fault fault = faultIn(mesh.deformations[p], primitives[p], joint_count,
                                  motion.nodes[mesh.node].weight_count)) {
            return fault;
        }
    }
    return {};
}

Fault faultIn(const Skin& skin, size_t node_count) {
    if (skin.joints.empty() || skin.joint_from_object.size() != skin.joints.size()) {
        return "expected joints, and an inverse bind matrix for each";
    }
    for (const uint32_t joint : skin.joints) {
        if (Fault fault = beyond("a joint", joint, node_count)) {
            return fault;
        }
    }
    return {};
}

Fault faultInPlaced(const Scene& scene) {
    const Motion& motion = *scene.motion;
    for (const MovedInstance& moved : motion.instances) {
        for (Fault fault :
             {beyond("a moved instance", moved.instance, scene.instances.size()),
              beyond("a moved instance's node", moved.node, motion.nodes.size()),
              moved.deformed == kNone
                  ? Fault()
                  : beyond("a moved instance's mesh", moved.deformed, motion.deformed.size())}) {
            if (fault) {
                return fault;
            }
        }
    }
    for (const auto& [things, count] : {std::pair(&motion.lights, scene.lights.size()),
                                        std::pair(&motion.cameras, scene.cameras.size())}) {
        for (const MovedThing& moved : *things) {
            if (Fault fault = beyond("a moved light or camera", moved.index, count)) {
                return fault;
            }
            if (Fault fault = beyond("its node", moved.node, motion.nodes.size())) {
                return fault;
            }
        }
    }
    return {};
}

} // namespace

Fault findMotionFault(const Scene& scene) {
    const Motion& motion = *scene.motion;
    const auto named = [](const char* what, size_t index, const std::string& fault) {
        return "the scene's " + std::string(what) + " " + std::to_string(index) + ": " + fault;
    };
    for (size_t i = 0; i < motion.nodes.size(); ++i) {
        const Node& node = motion.nodes[i];
        if ((node.parent != kNone && node.parent >= i) ||
            uint64_t{node.first_weight} + node.weight_count > motion.rest_weights.size()) {
            return named("node", i, "its parent comes after it, or its weights are not there");
        }
    }
    for (size_t i = 0; i < motion.skins.size(); ++i) {
        if (const Fault fault = faultIn(motion.skins[i], motion.nodes.size())) {
            return named("skin", i, *fault);
        }
    }
    for (size_t i = 0; i < motion.deformed.size(); ++i) {
        if (const Fault fault = faultIn(motion.deformed[i], scene)) {
            return named("deformed mesh", i, *fault);
        }
    }
    for (size_t i = 0; i < motion.clips.size(); ++i) {
        if (const Fault fault = faultIn(motion.clips[i], motion)) {
            return named("clip", i, *fault);
        }
    }
    const Fault fault = faultInPlaced(scene);
    return fault ? "the scene's motion: " + *fault : fault;
}

} // namespace froxel::scene
