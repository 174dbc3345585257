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
void nameCamera(scene::NamedCamera& camera,
                const std::string& node_name,
                const std::vector<scene::NamedCamera>& others) {
    if (camera.name.empty()) {
        camera.name = node_name.empty() ? "camera" + std::to_string(others.size()) : node_name;
    }
    const std::string wanted = camera.name;
    const auto taken = [&] {
        return std::any_of(others.begin(), others.end(), [&](const scene::NamedCamera& other) {
            return other.name == camera.name;
        });
    };
    for (size_t i = 2; taken(); ++i) {
        camera.name = wanted + "-" + std::to_string(i);
    }
}

class Builder {
  public:
    Builder(const Document& document, SceneFolder& folder, Warnings& warnings)
        : document_(document), warnings_(warnings), views_(document, folder),
          accessors_(document, views_), materials_(document, scene_, warnings),
          meshes_(document, views_, accessors_, materials_, scene_, warnings),
          placed_(placeNodes(document.model, warnings)),
          motion_(document, placed_, weightCounts(), accessors_, warnings) {}

    scene::Scene build(SceneFolder& folder) {
        for (uint32_t place = 0; place < placed_.size(); ++place) {
            if (placed_[place].visible) {
                addMesh(place);
                addLight(place);
            }
            addCamera(place);
        }
        meshes_.tellUndrawn();
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
        loadImages(document_, materials_.images(), folder, views_, scene_, warnings_);
        return std::move(scene_);
    }

  private:
    [[nodiscard]] const tinygltf::Node& nodeAt(size_t place) const {
        return document_.model.nodes[placed_[place].node];
    }
    [[nodiscard]] std::string nameOf(size_t place) const {
        return thing("node", placed_[place].node);
    }

    // Morph targets of what each placed node shows.
    [[nodiscard]] std::vector<size_t> weightCounts() const {
        std::vector<size_t> counts;
        for (size_t place = 0; place < placed_.size(); ++place) {
            const int mesh = nodeAt(place).mesh;
            counts.push_back(mesh < 0 ? 0 : meshes_.targetCount(mesh, nameOf(place)));
        }
        return counts;
    }

    // One for each target: the node's own win over the mesh's.
    [[nodiscard]] std::vector<double> weightsOf(const tinygltf::Node& node) const {
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
        motion_.addInstance(
            {static_cast<uint32_t>(scene_.instances.size()), place, glm::dmat4(1), deformed});
        scene_.instances.push_back({mesh, placed_[place].world_from_node, node.name});
    }

    void addInstances(uint32_t place, uint32_t mesh, bool moves) {
        const tinygltf::Node& node = nodeAt(place);
        const std::string name = nameOf(place);
        for (const glm::dmat4& node_from_object :
             nodeInstances(node, placed_[place].node, accessors_, instances_, warnings_)) {
            const glm::dmat4 world = placed_[place].world_from_node * node_from_object;
            checkUsable(world, name);
            if (!moves && glm::dmat3(world) == glm::dmat3(0)) {
                continue; // a point: nothing to see
            }
            if (moves) {
                motion_.addInstance({static_cast<uint32_t>(scene_.instances.size()), place,
                                     node_from_object, scene::kNone});
            }
            scene_.instances.push_back({mesh, world, node.name});
        }
    }

    void addCamera(uint32_t place) {
        const PlacedNode& placed = placed_[place];
        const tinygltf::Node& node = nodeAt(place);
        if (node.camera < 0) {
            return;
        }
        const auto& cameras = document_.model.cameras;
        const size_t index =
            checkedIndex(node.camera, cameras.size(), "camera", thing("node", placed.node));
        scene::NamedCamera camera =
            readCamera(cameras[index], placed.world_from_node, thing("camera", index));
        nameCamera(camera, node.name, scene_.cameras);
        if (motion_.moves(place)) {
            motion_.addCamera({static_cast<uint32_t>(scene_.cameras.size()), place});
        }
        scene_.cameras.push_back(std::move(camera));
    }

    void addLight(uint32_t place) {
        const PlacedNode& placed = placed_[place];
        const tinygltf::Node& node = nodeAt(place);
        const tinygltf::Value* extension = findExtension(node.extensions, "KHR_lights_punctual");
        if (extension == nullptr) {
            return;
        }
        const auto& lights = document_.model.lights;
        const size_t index = checkedIndex(intOr(*extension, "light", -1), lights.size(), "light",
                                          thing("node", placed.node));
        scene::PunctualLight light =
            readLight(lights[index], placed.world_from_node, thing("light", index));
        if (light.name.empty()) {
            light.name = node.name;
        }
        if (motion_.moves(place)) {
            motion_.addLight({static_cast<uint32_t>(scene_.lights.size()), place});
        }
        scene_.lights.push_back(std::move(light));
    }

    const Document& document_;
    Warnings& warnings_;
    scene::Scene scene_;
    BufferViews views_;
    AccessorReader accessors_;
    MaterialReader materials_;
    MeshReader meshes_;
    std::vector<PlacedNode> placed_;
    MotionReader motion_;
    Budget instances_{"instances", kMaxInstances};
};

} // namespace

scene::Scene buildScene(const Document& document, SceneFolder& folder, Warnings& warnings) {
    return Builder(document, folder, warnings).build(folder);
}

} // namespace froxel::gltf
