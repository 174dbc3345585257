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
#include "gltf/node_transform.h"
#include "gltf/node_walker.h"

#include <algorithm>
#include <string>

namespace froxel::gltf {
namespace {

BoundsD3 meshBounds(const scene::Mesh& mesh) {
    BoundsD3 bounds;
    for (const scene::Primitive& primitive : mesh.primitives) {
        bounds.add(BoundsD3{primitive.bounds.min, primitive.bounds.max});
    }
    return bounds;
}

void addCorners(const BoundsD3& object, const glm::dmat4& world_from_object, BoundsD3& world) {
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1U) != 0 ? object.max.x : object.min.x,
                               (corner & 2U) != 0 ? object.max.y : object.min.y,
                               (corner & 4U) != 0 ? object.max.z : object.min.z);
        world.add(glm::dvec3(world_from_object * glm::dvec4(point, 1)));
    }
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
          meshes_(document, views_, accessors_, materials_, scene_, warnings) {}

    scene::Scene build(SceneFolder& folder) {
        for (const PlacedNode& placed : placeNodes(document_.model, warnings_)) {
            if (placed.visible) {
                addInstances(placed);
                addLight(placed);
            }
            addCamera(placed);
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
            addCorners(bounds[instance.mesh], instance.world_from_object, scene_.bounds_world);
        }
        loadImages(document_, materials_.images(), folder, views_, scene_, warnings_);
        return std::move(scene_);
    }

  private:
    void addInstances(const PlacedNode& placed) {
        const tinygltf::Node& node = document_.model.nodes[placed.node];
        if (node.mesh < 0) {
            return;
        }
        const std::string name = thing("node", placed.node);
        const uint32_t mesh = meshes_.mesh(node.mesh, name);
        if (mesh == scene::kNone) {
            return;
        }
        const std::vector<glm::dmat4> transforms =
            nodeInstances(node, placed.node, accessors_, instances_, warnings_);
        if (!node.weights.empty() &&
            node.weights != document_.model.meshes[static_cast<size_t>(node.mesh)].weights) {
            warnings_.add(warning::kRestPose, pointerTo("nodes", placed.node) + "/weights",
                          "morph weights of nodes are ignored; their mesh's weights are used");
        }
        for (const glm::dmat4& node_from_object : transforms) {
            const glm::dmat4 world = placed.world_from_node * node_from_object;
            checkFinite(world, name);
            if (glm::dmat3(world) != glm::dmat3(0)) { // else a point: nothing to see
                scene_.instances.push_back({mesh, world, node.name});
            }
        }
    }

    void addCamera(const PlacedNode& placed) {
        const tinygltf::Node& node = document_.model.nodes[placed.node];
        if (node.camera < 0) {
            return;
        }
        const auto& cameras = document_.model.cameras;
        const size_t index =
            checkedIndex(node.camera, cameras.size(), "camera", thing("node", placed.node));
        scene::NamedCamera camera =
            readCamera(cameras[index], placed.world_from_node, thing("camera", index));
        nameCamera(camera, node.name, scene_.cameras);
        scene_.cameras.push_back(std::move(camera));
    }

    void addLight(const PlacedNode& placed) {
        const tinygltf::Node& node = document_.model.nodes[placed.node];
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
        scene_.lights.push_back(std::move(light));
    }

    const Document& document_;
    Warnings& warnings_;
    scene::Scene scene_;
    BufferViews views_;
    AccessorReader accessors_;
    MaterialReader materials_;
    MeshReader meshes_;
    Budget instances_{"instances", kMaxInstances};
};

} // namespace

scene::Scene buildScene(const Document& document, SceneFolder& folder, Warnings& warnings) {
    return Builder(document, folder, warnings).build(folder);
}

} // namespace froxel::gltf
