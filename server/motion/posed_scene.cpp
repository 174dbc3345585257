#include "motion/posed_scene.h"

#include "motion/affine.h"
#include "motion/player.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace froxel::motion {

namespace {

void bend(const Player& player, const Moment& moment, size_t deformed, scene::Mesh& mesh) {
    PosedVertices vertices;
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        scene::Primitive& primitive = mesh.primitives[p];
        player.deformAt(moment, deformed, p, vertices);
        primitive.positions = std::move(vertices.positions);
        primitive.normals = std::move(vertices.normals);
        primitive.tangents = std::move(vertices.tangents);
        primitive.bounds = {};
        for (const glm::vec3& position : primitive.positions) {
            primitive.bounds.add(position);
        }
    }
}

void placeCamera(const glm::dmat4& world_from_node, settings::Camera& camera) {
    if (const auto axes = axesOf(world_from_node)) {
        camera.eye_world = glm::dvec3(world_from_node[3]);
        camera.world_from_view = *axes;
    }
}

void placeCameras(scene::Scene& scene, const scene::Motion& motion, const Pose& pose) {
    for (const scene::MovedThing& moved : motion.cameras) {
        placeCamera(pose.world_from_node[moved.node], scene.cameras[moved.index].camera);
    }
}

auto nodeOfCamera(const scene::Motion& motion, uint32_t index) {
    return std::ranges::find(motion.cameras, index, &scene::MovedThing::index);
}

} // namespace

void placeCameras(scene::Scene& scene, std::span<const PlayedClip> clips, double time_s) {
    if (scene.motion) {
        Pose then;
        pose(*scene.motion, clips, time_s, then);
        placeCameras(scene, *scene.motion, then);
    }
}

bool movesCamera(const scene::Motion& motion, uint32_t index) {
    return nodeOfCamera(motion, index) != motion.cameras.end();
}

settings::Camera cameraAt(const scene::Motion& motion,
                          uint32_t index,
                          const Playing& playing,
                          settings::Camera camera) {
    const auto moved = nodeOfCamera(motion, index);
    if (moved != motion.cameras.end()) {
        Pose then;
        pose(motion, playing.clips, playing.now_s, then);
        placeCamera(then.world_from_node[moved->node], camera);
    }
    return camera;
}

scene::Scene posedScene(scene::Scene scene, std::span<const PlayedClip> clips, double time_s) {
    if (!scene.motion) {
        return scene;
    }
    const Player player(scene);
    const scene::Motion& motion = player.motion();
    Moment moment;
    player.at(clips, time_s, moment);
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        scene.instances[i].world_from_object = moment.instances[i];
    }
    for (size_t d = 0; d < motion.deformed.size(); ++d) {
        bend(player, moment, d, scene.meshes[motion.deformed[d].mesh]);
    }
    eachMovedLight(motion, moment.pose,
                   [&](uint32_t light, const glm::dvec3& position, const glm::dvec3& direction) {
                       scene.lights[light].position_world = position;
                       scene.lights[light].direction_world = direction;
                   });
    placeCameras(scene, motion, moment.pose);
    scene.bounds_world.add(moment.bounds_world);
    scene.motion = nullptr;
    return scene;
}

} // namespace froxel::motion
