// What of scenes is made beside what their files say.
#pragma once

namespace froxel::render {

struct SceneOptions {
    // Of meshes: for views that take a geometry error. Costs loading time, and as much memory for
    // indices and meshlets as the scene has.
    bool detail_levels = false;
};

} // namespace froxel::render
