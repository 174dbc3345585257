#include "app/scene_command.h"

#include "builtin_scene/hall.h"
#include "builtin_scene/spheres.h"
#include "core/error.h"
#include "gltf_writer/glb_writer.h"

namespace froxel::app {

void runScene(const SceneOptions& options) {
    const auto scene = options.spheres
                           ? builtin_scene::makeSpheres({.triangle_count = *options.spheres,
                                                         .copy_count = options.copies.value_or(1)})
                           : builtin_scene::makeHall();
    gltf_writer::writeGlb(scene, options.out).value();
}

} // namespace froxel::app
