#include "app/scene_command.h"

#include "builtin_scene/hall.h"
#include "core/error.h"
#include "gltf_writer/glb_writer.h"

namespace froxel::app {

void runScene(const SceneOptions& options) {
    gltf_writer::writeGlb(builtin_scene::makeHall(), options.out).value();
}

} // namespace froxel::app
