#include "gltf/scene_builder.h"

#include "gltf/accessor_reader.h"
#include "gltf/buffer_views.h"
#include "gltf/extension_value.h"
#include "gltf/image_loader.h"
#include "gltf/instancing.h"
#include "gltf/light_camera_reader.h"
#include "gltf/limits.h"
#include "gltf/material_reader.h"
#include "gltf/mesh_reader.h"
#include "gltf/motion_reader.h"
#include "gltf/node_transform.h"
#include "gltf/node_walker.h"
#include "motion/affine.h"
#include "motion/player.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace froxel::gltf {
namespace {

BoundsD3 meshBounds(const scene::Mesh& mesh) {
    BoundsD3 bounds;
    for (const scene::Primitive& primitive : mesh.primitives) {
        bounds.add(BoundsD3{primitive.bounds.min, primitive.bounds.max});
    }
    return bounds;
}

// Cameras are chosen by name, so every one gets a name of its own.
class CameraNames {
  public:
    // `wanted`, or that with the first number from 2 on that nobody has.
    std::string takeLike(const std::string& wanted) {
        std::string name = wanted;
        size_t& number = next_numbers_.try_emplace(wanted, 2).first->second;
        while (!taken_.insert(name).second) {
            name = wanted + "-" + std::to_string(number++);
        }
        return name;
    }

  private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, size_t> next_numbers_; // by what was wanted
};

class Builder {
  public:
    Builder(const Document& document,
            SceneFiles& files,
            LoadProgress& progress,
            ReadMemory& memory,
            Warnings& warnings)
        : document_(document), progress_(progress), memory_(memory), warnings_(warnings),
          views_(document, files, progress, memory), accessors_(document, views_),
          materials_(document, scene_, warnings),
          meshes_(document, views_, accessors_, materials_, scene_, memory, warnings),
          placed_(placeNodes(document.model, warnings)),
          motion_(document, placed_, weightCounts(), accessors_, memory, warnings) {}

    scene::Scene build(SceneFiles& files) {
        scene_.material_variants = document_.material_variants;
        for (uint32_t place = 0; place < placed_.size(); ++place) {
            progress_.reading(static_cast<double>(place) / static_cast<double>(placed_.size()));
            if (placed_[place].visible) {
                addMesh(place);
                addLight(place);
            }
            addCamera(place);
        }
        meshes_.tellUndrawn();
        tellTooMany("cameras", cameras_left_out_, warnings_);
        if (scene_.instances.empty()) {
            warnings_.add(warning::kNothingDrawn, "",
                          "nothing is drawn: no node of the scene places a mesh of triangles");
        }
        std::vector<BoundsD3> bounds;
        std::transform(scene_.meshes.begin(), scene_.meshes.end(), std::back_inserter(bounds),
                       meshBounds);
        for (const scene::Instance& instance : scene_.instances) {
            scene_.bounds_world.add(
                motion::transformed(bounds[instance.mesh], instance.world_from_object));
        }
        scene_.motion = motion_.finish();
        if (scene_.motion) {
            scene_.bounds_world = motion::boundsOverClips(scene_);
        }
        loadImages(document_, materials_.images(), files, views_, progress_, memory_, scene_,
                   warnings_);
        return std::move(scene_);
    }

  private:
    [[nodiscard]] const tinygltf::Node& nodeAt(size_t place) const {
        return document_.model.nodes[placed_[place].node];
    }
    [[nodiscard]] glm::dvec3 originOf(size_t place) const {
        return glm::dvec3(placed_[place].world_from_node[3]);
    }
    [[nodiscard]] std::string nameOf(size_t place) const {
        return thing("node", placed_[place].node);
    }

    // Morph targets of what each placed node shows.
    [[nodiscard]] std::vector<size_t> weightCounts() {
        Budget weights("weights of morph targets", kMaxMorphWeights, sizeof(double), memory_);
        std::vector<size_t> counts;
        for (size_t place = 0; place < placed_.size(); ++place) {
            const int mesh = nodeAt(place).mesh;
            counts.push_back(mesh < 0 ? 0 : meshes_.targetCount(mesh, nameOf(place)));
            weights.take(counts.back(), nameOf(place));
        }
        return counts;
    }

    // One for each target: the node's own win over the mesh's.
    [[nodiscard]] std::vector<double> weightsOf(const tinygltf::Node& node) {
        const auto& mesh = document_.model.meshes[static_cast<size_t>(node.mesh)];
        std::vector<double> weights = node.weights.empty() ? mesh.weights : node.weights;
        weights.resize(meshes_.targetCount(node.mesh, ""));
        return weights;
    }

    void addMesh(uint32_t place) {
        const tinygltf::Node& node = nodeAt(place);
        if (node.mesh < 0) {
            return;
        }
        const std::string name = nameOf(place);
        const std::optional<uint32_t> skin = motion_.skin(place);
        if (skin) {
            posed_joints_.take(motion_.jointCount(*skin), name);
        }
        const std::vector<double> weights = weightsOf(node);
        if (!skin && !motion_.morphs(place)) {
            const uint32_t mesh = meshes_.mesh(node.mesh, weights, name);
            if (mesh != scene::kNone) {
                addInstances(place, mesh, motion_.moves(place));
            }
            return;
        }
        scene::DeformedMesh deformed;
        deformed.node = place;
        deformed.skin = skin.value_or(scene::kNone);
        const MeshMotion how{motion_.morphs(place),
                             skin ? std::optional(motion_.jointCount(*skin)) : std::nullopt};
        deformed.mesh = meshes_.deformingMesh(node.mesh, weights, how, deformed.deformations, name);
        if (deformed.mesh == scene::kNone) {
            return;
        }
        const uint32_t mesh = deformed.mesh;
        const uint32_t index =
            motion_.addDeformed(std::move(deformed), how.morphs ? weights : std::vector<double>());
        if (skin) {
            addSkinned(place, mesh, index);
        } else {
            addInstances(place, mesh, true);
        }
    }

    // The node's own place counts for nothing.
    void addSkinned(uint32_t place, uint32_t mesh, uint32_t deformed) {
        const tinygltf::Node& node = nodeAt(place);
        if (findExtension(node.extensions, "EXT_mesh_gpu_instancing") != nullptr) {
            warnings_.add(warning::kSkinnedInstances,
                          pointerTo("nodes", placed_[place].node) +
                              "/extensions/EXT_mesh_gpu_instancing",
                          nameOf(place) + " has a skin and instances; the skin places it once");
        }
        instances_.take(1, nameOf(place));
        placed_primitives_.take(scene_.meshes[mesh].primitives.size(), nameOf(place));
        motion_.addInstance(
            {static_cast<uint32_t>(scene_.instances.size()), place, glm::dmat4(1), deformed});
        addInstance(place, mesh, placed_[place].world_from_node);
    }

    void addInstance(uint32_t place, uint32_t mesh, const glm::dmat4& world_from_object) {
        scene_.instances.push_back({mesh, world_from_object, nodeAt(place).name,
                                    static_cast<uint32_t>(placed_[place].node)});
    }

    void addInstances(uint32_t place, uint32_t mesh, bool moves) {
        const tinygltf::Node& node = nodeAt(place);
        for (const glm::dmat4& node_from_object :
             nodeInstances(node, placed_[place].node, accessors_, instances_, warnings_)) {
            const glm::dmat4 world = placed_[place].world_from_node * node_from_object;
            if (!isUsable(world, placed_[place].node, warnings_)) {
                continue;
            }
            if (!moves && glm::dmat3(world) == glm::dmat3(0)) {
                continue; // a point: nothing to see
            }
            placed_primitives_.take(scene_.meshes[mesh].primitives.size(), nameOf(place));
            if (moves) {
                motion_.addInstance({static_cast<uint32_t>(scene_.instances.size()), place,
                                     node_from_object, scene::kNone});
            }
            addInstance(place, mesh, world);
        }
    }

    // `index`, or none with a warning where the file has no such thing.
    std::optional<size_t>
    known(int index, size_t size, const char* kind, size_t place, const std::string& member) {
        if (index >= 0 && static_cast<size_t>(index) < size) {
            return static_cast<size_t>(index);
        }
        warnings_.add(warning::kUnresolved, pointerTo("nodes", placed_[place].node) + member,
                      nameOf(place) + " uses " + kind + " " + std::to_string(index) +
                          "; the file has " + std::to_string(size) +
                          ", counted from 0; it is left out");
        return std::nullopt;
    }

    // Of what moves, which may have a scale of 0 for a while, as if that were 1.
    [[nodiscard]] NodeAxes axesAt(uint32_t place) {
        const NodeAxes axes = motion::axesOf(placed_[place].world_from_node);
        if (axes || !motion_.moves(place)) {
            return axes;
        }
        while (unscaled_.size() <= place) { // parents come before their children
            const size_t at = unscaled_.size();
            const auto& parent = placed_[at].parent;
            scene::Transform parts = nodeParts(nodeAt(at));
            parts.scale = glm::dvec3(1);
            unscaled_.push_back((parent ? unscaled_[*parent] : glm::dmat4(1)) *
                                scene::matrixOf(parts));
        }
        return motion::axesOf(unscaled_[place]);
    }

    void addCamera(uint32_t place) {
        const tinygltf::Node& node = nodeAt(place);
        if (node.camera < 0) {
            return;
        }
        const auto& cameras = document_.cameras;
        const auto index = known(node.camera, cameras.size(), "camera", place, "/camera");
        auto camera =
            !index ? std::nullopt
                   : readCamera(cameras[*index], *index, originOf(place), axesAt(place), warnings_);
        if (!camera) {
            return;
        }
        if (scene_.cameras.size() == kMaxChoices) {
            ++cameras_left_out_;
            return;
        }
        const std::string number = std::to_string(scene_.cameras.size());
        camera->name = camera_names_.takeLike(!camera->name.empty() ? camera->name
                                              : !node.name.empty()  ? node.name
                                                                    : "camera" + number);
        if (motion_.moves(place)) {
            motion_.addCamera({static_cast<uint32_t>(scene_.cameras.size()), place});
        }
        scene_.cameras.push_back(std::move(*camera));
    }

    void addLight(uint32_t place) {
        const tinygltf::Node& node = nodeAt(place);
        const tinygltf::Value* extension = findExtension(node.extensions, "KHR_lights_punctual");
        if (extension == nullptr) {
            return;
        }
        const auto& lights = document_.lights;
        const auto index = known(intOr(*extension, "light", -1), lights.size(), "light", place,
                                 "/extensions/KHR_lights_punctual/light");
        auto light =
            !index ? std::nullopt
                   : readLight(lights[*index], *index, originOf(place), axesAt(place), warnings_);
        if (!light) {
            return;
        }
        if (light->name.empty()) {
            light->name = node.name;
        }
        if (motion_.moves(place)) {
            motion_.addLight({static_cast<uint32_t>(scene_.lights.size()), place});
        }
        scene_.lights.push_back(std::move(*light));
    }

    const Document& document_;
    LoadProgress& progress_;
    ReadMemory& memory_;
    Warnings& warnings_;
    scene::Scene scene_;
    BufferViews views_;
    AccessorReader accessors_;
    MaterialReader materials_;
    MeshReader meshes_;
    std::vector<PlacedNode> placed_;
    MotionReader motion_;
    std::vector<glm::dmat4> unscaled_; // of the first places: axesAt()
    CameraNames camera_names_;
    size_t cameras_left_out_ = 0;
    Budget instances_{"instances", kMaxInstances, kInstanceBytes, memory_};
    Budget placed_primitives_{"placed primitives", kMaxPlacedPrimitives, 0, memory_};
    Budget posed_joints_{"joints of meshes with a skin", kMaxPosedJoints, kPosedJointBytes,
                         memory_};
};

} // namespace

scene::Scene buildScene(const Document& document,
                        SceneFiles& files,
                        LoadProgress& progress,
                        ReadMemory& memory,
                        Warnings& warnings) {
    return Builder(document, files, progress, memory, warnings).build(files);
}

} // namespace froxel::gltf
