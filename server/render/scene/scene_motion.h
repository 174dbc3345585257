// How a scene moves, as all of its views share it.
#pragma once

#include "motion/player.h"
#include "render/scene/mesh_poser.h"

#include <memory>
#include <vector>

namespace froxel::render {

class DeviceResources;

struct SceneMotion {
    // The scene has motion. Throws as MeshPoser and PosePipelines do.
    SceneMotion(DeviceResources& shared,
                gpu::MemoryArena& arena,
                gpu::Uploader& uploader,
                const scene::Scene& scene,
                const PackedGeometry& geometry);

    motion::Player player;
    std::vector<motion::PlayedClip> clips;      // that play where nobody chose others
    std::vector<uint32_t> deformed_of_instance; // of Motion::deformed; scene::kNone: rigid
    std::unique_ptr<const MeshPoser> poser;     // null: no mesh bends
};

} // namespace froxel::render
