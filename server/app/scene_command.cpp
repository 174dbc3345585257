#include "app/scene_command.h"

#include "core/error.h"
#include "gltf_writer/glb_writer.h"
#include "hall/hall.h"

namespace froxel::app {

void runScene(const SceneOptions& options) {
    gltf_writer::writeGlb(hall::makeHall(), options.out).value();
}

} // namespace froxel::app
