// What of a scene moves: its nodes, clips of keys that play on them, and the skins and morph
// targets that follow. Plain data on the host; server/motion plays it. Nothing here concerns what
// rests.
#pragma once

#include "core/math.h"
#include "scene/scene.h"
#include "scene/transform.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace froxel::scene {

enum class Interpolation : uint8_t { kStep, kLinear, kCubicSpline };
enum class ChannelPath : uint8_t { kTranslation, kRotation, kScale, kWeights };

// Values over time (glTF 2.0, 3.11 and appendix C).
struct Track {
    Interpolation interpolation = Interpolation::kLinear;
    uint32_t width = 3;         // numbers a value: 3; of rotations 4 (x, y, z, w); of weights as
                                // many as there are targets
    std::vector<float> times_s; // of the keys: at least one, never falling
    std::vector<float> values;  // [key][width]; splines: [key][3][width], tangent into the key,
                                // value, tangent out of it. Finite
};

struct Channel {
    uint32_t track = 0; // of the clip
    uint32_t node = 0;
    ChannelPath path = ChannelPath::kTranslation; // each at most once a node and clip
};

struct Clip {
    std::string name; // as the file has it: may be empty, may be another's
    double duration_s = 0;
    std::vector<Track> tracks;
    std::vector<Channel> channels;
};

struct Node {
    uint32_t parent = kNone;          // before it in Motion::nodes
    Transform rest;                   // without clips
    std::optional<glm::dmat4> matrix; // instead of `rest`; no channel moves the node then
    uint32_t first_weight = 0;        // of Motion::rest_weights
    uint32_t weight_count = 0;        // of the morph targets of what it places
};

struct Skin {
    std::string name;
    std::vector<uint32_t> joints;             // nodes
    std::vector<glm::mat4> joint_from_object; // inverse bind matrices, one a joint
};

// A vertex's part in a skin.
struct Influence {
    uint32_t joint = 0; // of Skin::joints
    float weight = 1;   // above 0; those of a vertex sum to 1
};

// What one morph target adds to a vertex at a weight of 1.
struct MorphDelta {
    uint32_t target = 0;
    glm::vec3 position{0};
    glm::vec3 normal{0};
    glm::vec3 tangent{0};
};

// How the vertices of a primitive move, vertex by vertex: those of vertex v are the elements
// [first[v], first[v + 1]), so that sums have one order and sparse targets cost nothing.
struct Deformation {
    std::vector<uint32_t> first_influence; // empty: not skinned; else one a vertex and the end
    std::vector<Influence> influences;
    std::vector<uint32_t> first_delta; // empty: no targets; else one a vertex and the end
    std::vector<MorphDelta> deltas;    // of a vertex by rising target
    bool flat_normals = false;         // the file has none: they are those of the moved triangles
};

// A mesh that deforms. Its primitives hold the vertices without skin and at weights of 0.
struct DeformedMesh {
    uint32_t mesh = 0;                     // of Scene::meshes; no other deformed mesh has it
    uint32_t node = 0;                     // whose weights it has
    uint32_t skin = kNone;                 // none: morph targets alone
    std::vector<Deformation> deformations; // as the mesh's primitives
};

// A placed thing that goes where its node goes.
struct MovedInstance {
    uint32_t instance = 0; // of Scene::instances
    uint32_t node = 0;
    glm::dmat4 node_from_object{1};
    uint32_t deformed = kNone; // of Motion::deformed, where a skin places it instead of the node
};
struct MovedThing {
    uint32_t index = 0; // of Scene::lights or Scene::cameras
    uint32_t node = 0;
};

struct Motion {
    std::vector<Node> nodes; // parents before children
    std::vector<float> rest_weights;
    std::vector<Skin> skins;
    std::vector<DeformedMesh> deformed;
    std::vector<MovedInstance> instances; // the others stay where Scene::instances has them
    std::vector<MovedThing> lights;
    std::vector<MovedThing> cameras;
    std::vector<Clip> clips;
    uint32_t played = 0; // of clips, where nobody chose another; none there: nothing plays
};

[[nodiscard]] inline std::vector<std::string> namesOf(const std::vector<Clip>& clips) {
    std::vector<std::string> names;
    for (const Clip& clip : clips) {
        names.push_back(clip.name);
    }
    return names;
}

} // namespace froxel::scene
