#include "render/visibility_instances.h"

namespace froxel::render {

void placeInstances(const SceneResources& scene,
                    const view::Camera& camera,
                    std::span<const InstanceRows> rows,
                    std::vector<io::InstanceView>& out) {
    out.resize(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
        const glm::dmat4& world = scene.instances[i];
        const glm::dmat3 linear(world);
        // Of a flattened instance the eye has no place in object space; shaders take what is far
        // away as unknown.
        const glm::dvec3 eye =
            glm::inverse(linear) * (camera.eye_world - glm::dvec3(world[3]));
        const bool known = glm::all(glm::lessThan(glm::abs(eye), glm::dvec3(1e30)));
        out[i] = {rows[i].row[0], rows[i].row[1], rows[i].row[2],
                  known ? glm::vec3(eye) : glm::vec3(1e30F),
                  glm::determinant(linear) < 0 ? 1U : 0U};
    }
}

} // namespace froxel::render
