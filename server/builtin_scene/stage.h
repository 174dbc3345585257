// A scene under construction: one mesh, many places.
#pragma once

#include "builtin_scene/mesh_builder.h"
#include "scene/scene.h"

#include <string>
#include <utility>

namespace froxel::builtin_scene {

class Stage {
  public:
    explicit Stage(scene::Scene& scene) : scene_(scene) {}

    uint32_t mesh(std::string name, const MeshBuilder& builder) {
        scene_.meshes.push_back(builder.build(std::move(name)));
        return static_cast<uint32_t>(scene_.meshes.size() - 1);
    }
    void place(uint32_t mesh, const glm::mat4& world_from_object) {
        scene_.instances.push_back({mesh, glm::dmat4(world_from_object), scene_.meshes[mesh].name});
    }
    void place(std::string name, const MeshBuilder& builder) {
        place(mesh(std::move(name), builder), glm::mat4(1.0F));
    }
    // On both sides of the nave: as given for the north (z < 0), and turned for the south.
    void placeBothSides(uint32_t mesh, const glm::mat4& world_from_object) {
        place(mesh, world_from_object);
        place(mesh, turnedY(glm::pi<float>()) * world_from_object);
    }

  private:
    scene::Scene& scene_;
};

} // namespace froxel::builtin_scene
