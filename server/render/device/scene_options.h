// What of scenes is made beside what their files say.
#pragma once

#include <filesystem>

namespace froxel::render {

struct SceneOptions {
    // Of meshes: for views that take a geometry error. Costs loading time, and as much memory for
    // indices and meshlets as the scene has.
    bool detail_levels = false;
    // PackOptions::cache_folder.
    std::filesystem::path geometry_cache{};
};

} // namespace froxel::render
