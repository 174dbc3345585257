// Which triangle of the scene each pixel of a frame shows, for whoever shades it again. Not a fast
// path: packs the scene's geometry once more to know its triangles by their place in the scene.
#pragma once

#include "core/error.h"
#include "core/visibility.h"
#include "render/view/renderer.h"
#include "scene/scene.h"

namespace froxel::render {

class MaterialSet;
struct ViewTargets;

// Draws the solid surfaces of `inputs` by the visibility passes, without lights, and reads them
// back: whatever `inputs` says of renderer and lighting. `scene` is the renderer's. The render
// thread. Errors: as ViewRenderer's.
[[nodiscard]] Result<Visibility>
readVisibility(Renderer& renderer, const scene::Scene& scene, FrameInputs inputs);

// The same of a frame that took the visibility passes and is complete, out of its targets.
// Throws vk::SystemError.
[[nodiscard]] Visibility copyVisibility(SceneResources& resources,
                                        MaterialSet& material_set,
                                        const ViewTargets& targets,
                                        const scene::Scene& scene);

} // namespace froxel::render
