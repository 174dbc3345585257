#include "motion/pose.h"

#include "core/assert.h"
#include "motion/sample.h"

#include <algorithm>

namespace froxel::motion {

namespace {

using scene::ChannelPath;

// What clips have added up of one property.
struct Sum {
    glm::dvec4 value{0};
    double weight = 0;

    void add(const glm::dvec4& sampled, double share, bool rotation) {
        const bool other_side = rotation && weight > 0 && glm::dot(value, sampled) < 0;
        value += share * (other_side ? -sampled : sampled);
        weight += share;
    }
    // With the rest pose's share, or without what is too much.
    [[nodiscard]] glm::dvec4 whole(const glm::dvec4& rest, bool rotation) const {
        Sum sum = *this;
        if (weight < 1) {
            sum.add(rest, 1 - weight, rotation);
        } else if (weight > 1) {
            sum.value /= weight; // of rotations only the direction counts
        }
        return sum.value;
    }
};

struct NodeSums {
    Sum translation;
    Sum rotation;
    Sum scale;
};

glm::dvec4 asVector(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

class Blend {
  public:
    Blend(const scene::Motion& motion, Pose& out)
        : motion_(motion), out_(out), nodes_(motion.nodes.size()),
          weights_(motion.rest_weights.size()) {}

    void add(const PlayedClip& played, double share, double time_s) {
        if (!(share > 0) || played.clip == scene::kNone) {
            return;
        }
        FROXEL_ASSERT(played.clip < motion_.clips.size(), "a played clip is the scene's");
        const scene::Clip& clip = motion_.clips[played.clip];
        const double clip_s = played.clock.timeAt(time_s, clip.duration_s);
        for (const scene::Channel& channel : clip.channels) {
            const scene::Track& track = clip.tracks[channel.track];
            if (channel.path == ChannelPath::kWeights) {
                addWeights(track, clip_s, share, motion_.nodes[channel.node]);
            } else {
                addPart(track, clip_s, share, channel);
            }
        }
    }

    void finish() {
        out_.weights.resize(weights_.size());
        for (size_t i = 0; i < weights_.size(); ++i) {
            out_.weights[i] = weights_[i].whole({motion_.rest_weights[i], 0, 0, 0}, false).x;
        }
        out_.world_from_node.resize(nodes_.size());
        for (size_t i = 0; i < nodes_.size(); ++i) {
            const scene::Node& node = motion_.nodes[i];
            const glm::dmat4 parent_from_node =
                node.matrix ? *node.matrix : scene::matrixOf(partsOf(node, nodes_[i]));
            out_.world_from_node[i] = node.parent == scene::kNone
                                          ? parent_from_node
                                          : out_.world_from_node[node.parent] * parent_from_node;
        }
    }

  private:
    void
    addPart(const scene::Track& track, double clip_s, double share, const scene::Channel& channel) {
        glm::dvec4 value(0);
        const bool rotation = channel.path == ChannelPath::kRotation;
        sample(track, clip_s, rotation, std::span(&value.x, track.width));
        NodeSums& node = nodes_[channel.node];
        Sum& sum = rotation                                    ? node.rotation
                   : channel.path == ChannelPath::kTranslation ? node.translation
                                                               : node.scale;
        sum.add(value, share, rotation);
    }
    void
    addWeights(const scene::Track& track, double clip_s, double share, const scene::Node& node) {
        sampled_.resize(track.width);
        sample(track, clip_s, false, sampled_);
        for (uint32_t i = 0; i < node.weight_count; ++i) {
            weights_[node.first_weight + i].add({sampled_[i], 0, 0, 0}, share, false);
        }
    }
    // A part that no clip moves is the rest pose's own.
    [[nodiscard]] static scene::Transform partsOf(const scene::Node& node, const NodeSums& sums) {
        scene::Transform parts = node.rest;
        if (sums.translation.weight > 0) {
            parts.translation = sums.translation.whole({node.rest.translation, 0}, false);
        }
        if (sums.rotation.weight > 0) {
            const glm::dvec4 rest = asVector(glm::normalize(node.rest.rotation));
            const glm::dvec4 q = sums.rotation.whole(rest, true);
            parts.rotation = glm::dquat(q.w, q.x, q.y, q.z);
        }
        if (sums.scale.weight > 0) {
            parts.scale = sums.scale.whole({node.rest.scale, 0}, false);
        }
        return parts;
    }

    const scene::Motion& motion_;
    Pose& out_;
    std::vector<NodeSums> nodes_;
    std::vector<Sum> weights_;
    std::vector<double> sampled_;
};

} // namespace

uint32_t usualAnimation(const scene::Motion& motion) {
    return motion.played < motion.clips.size() ? motion.played + 1 : 0;
}

std::vector<PlayedClip> usualClips(const scene::Motion& motion) {
    if (usualAnimation(motion) == 0) {
        return {};
    }
    return {PlayedClip{.clip = motion.played, .clock = {}, .fade = {}}};
}

void pose(const scene::Motion& motion,
          std::span<const PlayedClip> clips,
          double time_s,
          Pose& out) {
    std::vector<double> shares(clips.size());
    double uncovered = 1;
    for (size_t i = clips.size(); i-- > 0;) {
        const double weight = clips[i].fade.weightAt(time_s);
        shares[i] = uncovered * weight;
        uncovered *= clips[i].covers ? 1 - weight : 1;
    }
    Blend blend(motion, out);
    for (size_t i = 0; i < clips.size(); ++i) {
        blend.add(clips[i], shares[i], time_s);
    }
    blend.finish();
}

} // namespace froxel::motion
