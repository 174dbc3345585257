// The host's part of shadow maps: which lights have them and what is drawn into each face. Nothing
// of a map depends on the camera: rows are made in double from world positions, along the world's
// axes (a spot's along its own), so that texels stay as they are while the camera moves.
#pragma once

#include "core/frame_stats.h"
#include "gpu/vulkan.h"
#include "interface/frame_io.h"
#include "interface/shadow_io.h"
#include "light/frame_lights.h"
#include "light/light_rig.h"
#include "render/frame/draw_list.h"
#include "render/scene/scene_resources.h"
#include "settings/settings.h"

#include <cstdint>
#include <vector>

namespace froxel::render {

// Of one face: draws of one pipeline and material.
struct ShadowGroup {
    uint32_t material = 0;
    MaterialFlags material_flags = 0; // 0: opaque, no material is looked at
    uint32_t first_command = 0;
    uint32_t command_count = 0;
};

// One tile of the atlas.
struct ShadowFace {
    uint32_t tile = 0;
    uint32_t first_group = 0;
    uint32_t group_count = 0;
    bool bends = false;     // it shows posed vertices
    bool transmits = false; // some casters of its light let light pass
};

// Keep one and build into it again: its buffers are reused.
struct ShadowFrame {
    std::vector<uint32_t> shadow_of_light; // of each local light: into `lights`, or io::kNoShadow
    std::vector<io::ShadowLight> lights;   // in light order
    std::vector<ShadowFace> faces;
    std::vector<ShadowGroup> groups;
    std::vector<InstanceRows> rows; // face_from_object, over the light's reach
    std::vector<vk::DrawIndexedIndirectCommand> commands; // empty: nothing casts a shadow
    io::Frame uniforms{};                                 // of the passes that draw maps
    uint32_t triangle_count = 0;

    // Whether some casters let light pass.
    [[nodiscard]] bool transmits() const;
    void clear();
};

// Where a light with maps stands, in the world.
struct ShadowPlace {
    glm::dvec3 position_world{0};
    glm::dmat3 world_from_light{1}; // columns: the axes of io::ShadowLight
    double reach_m = 0;
    uint32_t face_count = 6;
    double scale = 1; // io::ShadowLight::scale
};

// Whether a face shows in `b` what it shows in `a`, but for posed vertices: compares all that its
// draws read.
[[nodiscard]] bool sameFace(const ShadowFrame& a, const ShadowFrame& b, size_t face);

// A spot of up to 60 degrees from its axis has one map, a wider one six like a point light.
[[nodiscard]] ShadowPlace
shadowPlace(const light::LightRig::Place& place, double reach_m, uint32_t size_px);

// Whether a ball may show in a face (2 * axis + (negative ? 1 : 0)); all in units of the reach, in
// the light's frame. Never false for a ball that does.
[[nodiscard]] bool meetsFace(const glm::dvec3& center, double radius, uint32_t face, double scale);

// Chooses lights (light/shadow_choice.h) and culls casters, meshlet by meshlet, against each face's
// pyramid and the light's ball. Opaque and masked surfaces cast shadows, from both sides, and
// those that transmit light dim it; blended ones do not, nor do those that glow all over (an
// emissive factor without a texture): a lamp's light stands inside its bulb. Pure.
void buildShadows(const SceneResources& scene,
                  const ScenePose& pose,
                  const light::FrameLights& lights,
                  const settings::ViewSettings& settings,
                  double time_s,
                  ShadowFrame& out);

} // namespace froxel::render
