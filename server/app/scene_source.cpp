#include "app/scene_source.h"

#include "gltf/gltf_loader.h"
#include "hall/hall.h"

namespace froxel::app {

Result<scene::Scene> loadScene(const std::string& source) {
    if (source == "builtin") {
        return hall::makeHall();
    }
    return gltf::load(source);
}

} // namespace froxel::app
