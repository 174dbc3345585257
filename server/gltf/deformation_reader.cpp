#include "gltf/deformation_reader.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace froxel::gltf {
namespace {

// Of a sum of weights: more is worth a word.
constexpr double kUsualError = 1e-3;

// One JOINTS_n with its WEIGHTS_n.
struct InfluenceSet {
    std::vector<glm::vec4> joints;
    std::vector<glm::vec4> weights;
};

// How many vertices are not as they should be.
struct Oddities {
    size_t not_finite = 0;
    size_t without_weights = 0;
    size_t off_one = 0;
};

std::vector<InfluenceSet>
readSets(VertexSource& source, size_t count, Budget& budget, const std::string& user) {
    std::vector<InfluenceSet> sets;
    for (;;) {
        const std::string number = std::to_string(sets.size());
        const std::string joints = "JOINTS_" + number;
        const std::string weights = "WEIGHTS_" + number;
        if (!source.has(joints) || !source.has(weights)) {
            return sets;
        }
        budget.take(uint64_t{count} * 4, user + " " + joints);
        InfluenceSet& set = sets.emplace_back();
        set.joints = source.vectors<4>(joints, count);
        set.weights = source.vectors<4>(weights, count);
    }
}

uint32_t jointOf(float number, size_t joint_count, const std::string& user) {
    if (!(number >= 0 && number < static_cast<float>(joint_count)) ||
        number != std::floor(number)) {
        fail(user + " uses joint " + numberText(number) + "; its skin has " +
             std::to_string(joint_count) + ", counted from 0");
    }
    return static_cast<uint32_t>(number);
}

// Appends the vertex's influences, of a sum of 1.
void addVertex(const std::vector<InfluenceSet>& sets,
               size_t vertex,
               size_t joint_count,
               scene::Deformation& out,
               Oddities& odd,
               const std::string& user) {
    const size_t first = out.influences.size();
    double sum = 0;
    bool finite = true;
    for (const InfluenceSet& set : sets) {
        for (int i = 0; i < 4; ++i) {
            const float weight = set.weights[vertex][i];
            finite = finite && std::isfinite(weight);
            if (weight > 0 && std::isfinite(weight)) { // else the joint is not one
                out.influences.push_back({jointOf(set.joints[vertex][i], joint_count,
                                                  user + " vertex " + std::to_string(vertex)),
                                          weight});
                sum += weight;
            }
        }
    }
    odd.not_finite += finite ? 0U : 1U;
    if (!(sum > 0)) {
        out.influences.push_back({0, 1});
        ++odd.without_weights;
        return;
    }
    odd.off_one += std::abs(sum - 1) > kUsualError ? 1U : 0U;
    for (size_t i = first; sum != 1 && i < out.influences.size(); ++i) {
        out.influences[i].weight = static_cast<float>(out.influences[i].weight / sum);
    }
}

bool isZero(const scene::MorphDelta& delta) {
    constexpr glm::vec3 kZero(0);
    return delta.position == kZero && delta.normal == kZero && delta.tangent == kZero;
}

// Elements of vertices [first[v], first[v + 1]) as those of corners.
template <class T>
void unshare(std::vector<T>& elements,
             std::vector<uint32_t>& first,
             const std::vector<uint32_t>& corners,
             Budget& budget) {
    if (first.empty()) {
        return;
    }
    const uint64_t total =
        std::accumulate(corners.begin(), corners.end(), uint64_t{0}, [&](uint64_t sum, uint32_t v) {
            return sum + first[v + size_t{1}] - first[v];
        });
    budget.take(total, "a mesh without NORMAL");
    std::vector<T> moved;
    moved.reserve(total);
    std::vector<uint32_t> starts{0};
    starts.reserve(corners.size() + 1);
    for (const uint32_t v : corners) {
        moved.insert(moved.end(), elements.begin() + first[v],
                     elements.begin() + first[v + size_t{1}]);
        starts.push_back(static_cast<uint32_t>(moved.size()));
    }
    elements = std::move(moved);
    first = std::move(starts);
}

} // namespace

void DeformationReader::readInfluences(VertexSource& source,
                                       const scene::Primitive& primitive,
                                       size_t joint_count,
                                       scene::Deformation& out,
                                       const std::string& pointer,
                                       const std::string& user) {
    const size_t count = primitive.positions.size();
    const std::vector<InfluenceSet> sets = readSets(source, count, influences_, user);
    Oddities odd;
    out.first_influence.push_back(0);
    for (size_t v = 0; v < count; ++v) {
        addVertex(sets, v, joint_count, out, odd, user);
        out.first_influence.push_back(static_cast<uint32_t>(out.influences.size()));
    }
    const auto tell = [&](const WarningKind& kind, size_t vertices, const char* what) {
        if (vertices > 0) {
            warnings_.add(kind, pointer + "/attributes/WEIGHTS_0",
                          user + " has " + std::to_string(vertices) + " vertices " + what);
        }
    };
    tell(warning::kNotFinite, odd.not_finite,
         "with joint weights that are not finite; these joints do not move them");
    tell(warning::kNoWeights, odd.without_weights, "without joint weights; they follow joint 0");
    tell(warning::kWeightSum, odd.off_one, "whose joint weights do not sum to 1; they are scaled");
}

std::vector<glm::vec3> DeformationReader::deltasOf(const MorphTarget& target,
                                                   const char* semantic,
                                                   size_t count,
                                                   const std::string& user) {
    const auto found = target.find(semantic);
    if (found == target.end() || count == 0) { // nothing to move
        return {};
    }
    const std::string name = user + " morph target " + semantic;
    if (accessors_.count(found->second, name) != count) {
        fail(name + " has " + std::to_string(accessors_.count(found->second, name)) +
             " elements; expected " + std::to_string(count) + ", as POSITION has");
    }
    morphed_vertices_.take(count, name);
    return accessors_.vectors<3>(found->second, name);
}

void DeformationReader::readTargets(const std::vector<MorphTarget>& targets,
                                    const scene::Primitive& primitive,
                                    scene::Deformation& out,
                                    const std::string& user) {
    const size_t count = primitive.positions.size();
    std::vector<std::pair<uint32_t, scene::MorphDelta>> found; // vertex and what moves it
    std::vector<uint32_t> first(count + 1, 0);
    for (uint32_t t = 0; t < targets.size(); ++t) {
        const auto positions = deltasOf(targets[t], "POSITION", count, user);
        const auto normals = deltasOf(targets[t], "NORMAL", primitive.normals.size(), user);
        const auto tangents = deltasOf(targets[t], "TANGENT", primitive.tangents.size(), user);
        const auto at = [](const std::vector<glm::vec3>& stream, uint32_t v) {
            return stream.empty() ? glm::vec3(0) : stream[v];
        };
        for (uint32_t v = 0; v < count; ++v) {
            const scene::MorphDelta delta{t, at(positions, v), at(normals, v), at(tangents, v)};
            if (!isZero(delta)) {
                deltas_.take(1, user);
                found.emplace_back(v, delta);
                ++first[v + size_t{1}];
            }
        }
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    out.deltas.resize(found.size());
    std::vector<uint32_t> next = first;
    for (const auto& [vertex, delta] : found) {
        out.deltas[next[vertex]++] = delta;
    }
    out.first_delta = std::move(first);
}

void DeformationReader::applyTargets(const std::vector<MorphTarget>& targets,
                                     const std::vector<double>& weights,
                                     scene::Primitive& primitive,
                                     const std::string& user) {
    const auto add = [&](const MorphTarget& target, const char* semantic, float weight,
                         std::vector<glm::vec3>& stream) {
        if (stream.empty()) {
            return;
        }
        const std::vector<glm::vec3> deltas = deltasOf(target, semantic, stream.size(), user);
        for (size_t i = 0; i < deltas.size(); ++i) {
            stream[i] += weight * deltas[i];
            if (!std::isfinite(stream[i].x + stream[i].y + stream[i].z)) {
                fail(user + " morph target " + semantic + " takes element " + std::to_string(i) +
                     " out of range with the weight " + numberText(weight) +
                     "; expected finite sums");
            }
        }
    };
    for (size_t i = 0; i < targets.size() && i < weights.size(); ++i) {
        if (weights[i] != 0) {
            const auto weight = static_cast<float>(weights[i]);
            add(targets[i], "POSITION", weight, primitive.positions);
            add(targets[i], "NORMAL", weight, primitive.normals);
        }
    }
}

void DeformationReader::makeFlat(const std::vector<uint32_t>& corners,
                                 scene::Deformation& deformation) {
    deformation.flat_normals = true;
    unshare(deformation.influences, deformation.first_influence, corners, influences_);
    unshare(deformation.deltas, deformation.first_delta, corners, deltas_);
}

void DeformationReader::addCopies(const std::vector<uint32_t>& of,
                                  scene::Deformation& deformation) {
    const auto add = [&](auto& elements, std::vector<uint32_t>& first, Budget& budget) {
        for (size_t i = 0; !first.empty() && i < of.size(); ++i) {
            budget.take(first[of[i] + size_t{1}] - first[of[i]], "a tangent");
            for (uint32_t at = first[of[i]]; at < first[of[i] + size_t{1}]; ++at) {
                const auto element = elements[at]; // which may move
                elements.push_back(element);
            }
            first.push_back(static_cast<uint32_t>(elements.size()));
        }
    };
    add(deformation.influences, deformation.first_influence, influences_);
    add(deformation.deltas, deformation.first_delta, deltas_);
}

} // namespace froxel::gltf
