#include "render/scene/scene_motion.h"

#include "render/device/device_resources.h"

namespace froxel::render {

SceneMotion::SceneMotion(DeviceResources& shared,
                         gpu::MemoryArena& arena,
                         gpu::Uploader& uploader,
                         const scene::Scene& scene,
                         const PackedGeometry& geometry)
    : player(scene), clips(motion::usualClips(*scene.motion)) {
    const auto& deformed = scene.motion->deformed;
    std::vector<uint32_t> of_mesh(scene.meshes.size(), scene::kNone);
    for (uint32_t d = 0; d < deformed.size(); ++d) {
        of_mesh[deformed[d].mesh] = d;
    }
    for (const scene::Instance& instance : scene.instances) {
        deformed_of_instance.push_back(of_mesh[instance.mesh]);
    }
    if (!deformed.empty()) {
        poser = std::make_unique<const MeshPoser>(shared.posePipelines(), arena, uploader, scene,
                                                  geometry);
        if (poser->jobs.empty()) { // meshes without vertices
            poser.reset();
        }
    }
}

} // namespace froxel::render
