// How the vertices of one primitive move: influences of a skin's joints, and morph targets.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/limits.h"
#include "gltf/vertex_source.h"
#include "gltf/warnings.h"
#include "scene/motion.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace froxel::gltf {

using MorphTarget = std::map<std::string, int>; // semantic to accessor

// Not thread-safe. Throws Failure, naming `user`.
class DeformationReader {
  public:
    DeformationReader(AccessorReader& accessors, ReadMemory& memory, Warnings& warnings)
        : accessors_(accessors), warnings_(warnings),
          influences_("influences of joints", kMaxInfluences, kInfluenceBytes, memory),
          morphed_vertices_("vertices of morph targets", kMaxVertices, sizeof(glm::vec3), memory),
          deltas_("moved vertices of morph targets", kMaxMorphDeltas, kMorphDeltaBytes, memory) {}

    // All sets of JOINTS_n and WEIGHTS_n. Weights are made to sum to 1, those that are not finite
    // are none; a vertex without any follows joint 0. `pointer` is the primitive's.
    void readInfluences(VertexSource& source,
                        const scene::Primitive& primitive,
                        size_t joint_count,
                        scene::Deformation& out,
                        const std::string& pointer,
                        const std::string& user);
    // Only what is not 0, of the streams that the primitive has.
    void readTargets(const std::vector<MorphTarget>& targets,
                     const scene::Primitive& primitive,
                     scene::Deformation& out,
                     const std::string& user);
    // Adds weights[i] of each target to the streams, once and for all.
    void applyTargets(const std::vector<MorphTarget>& targets,
                      const std::vector<double>& weights,
                      scene::Primitive& primitive,
                      const std::string& user);
    // As makeFlat() does with the streams: vertex i is then what corners[i] was.
    void makeFlat(const std::vector<uint32_t>& corners, scene::Deformation& deformation);
    // Puts copies of vertices at the end.
    void addCopies(const std::vector<uint32_t>& of, scene::Deformation& deformation);

  private:
    // The target's own of a stream; empty where it has none.
    [[nodiscard]] std::vector<glm::vec3> deltasOf(const MorphTarget& target,
                                                  const char* semantic,
                                                  size_t count,
                                                  const std::string& user);

    AccessorReader& accessors_;
    Warnings& warnings_;
    Budget influences_;
    Budget morphed_vertices_;
    Budget deltas_;
};

} // namespace froxel::gltf
