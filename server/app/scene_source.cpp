#include "app/scene_source.h"

#include "builtin_scene/hall.h"
#include "gltf/gltf_loader.h"

namespace froxel::app {

Result<scene::Scene> loadScene(const std::string& source) {
    if (source == "builtin") {
        return builtin_scene::makeHall();
    }
    return gltf::load(source);
}

} // namespace froxel::app
