// A loaded scene on the host: flat arrays, validated, independent of file formats and of the GPU.
#pragma once

#include "core/file_stamp.h"
#include "core/kept_bytes.h"
#include "core/math.h"
#include "interface/material_factors.h"
#include "interface/material_slots.h"
#include "scene/warning.h"
#include "settings/camera.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::environment {
struct Surroundings;
}

namespace froxel::scene {

struct Motion;

inline constexpr uint32_t kNone = 0xffffffffU;

enum class Wrap : uint8_t { kRepeat, kMirroredRepeat, kClampToEdge };
enum class Filter : uint8_t { kNearest, kLinear };

struct Sampler {
    Wrap wrap_u = Wrap::kRepeat;
    Wrap wrap_v = Wrap::kRepeat;
    Filter mag = Filter::kLinear;
    Filter min = Filter::kLinear;
    Filter mip = Filter::kLinear;
    bool mipmapped = true; // false: only the base level is ever read
    bool operator==(const Sampler&) const = default;
};

struct Image {
    std::string name;
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    KeptBytes rgba8; // [height][width][4], top row first; how it is encoded (sRGB or linear)
                     // depends on the slot that uses it
    // Levels 1 and on that a file gives, each half of the one before, rounded down, but at least 1;
    // what it does not give is made by halving.
    std::vector<KeptBytes> mips{};
};

struct Texture {
    uint32_t image = kNone;
    uint32_t sampler = kNone; // kNone: Sampler{}
};

// uv_texture = offset + rotation * scale * uv_vertex (KHR_texture_transform).
struct TextureSlot {
    uint32_t texture = kNone;
    uint32_t texcoord = 0; // 0 or 1
    glm::vec2 offset{0, 0};
    float rotation_rad = 0;
    glm::vec2 scale{1, 1};
};

enum class AlphaMode : uint8_t { kOpaque, kMask, kBlend };

struct Material {
    std::string name;
    glm::vec4 base_color{1, 1, 1, 1}; // linear
    float metallic = 1;
    float roughness = 1;
    float normal_scale = 1;
    float occlusion_strength = 1;
    glm::vec3 emissive{0, 0, 0}; // linear; may exceed 1
    AlphaMode alpha_mode = AlphaMode::kOpaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;
    // What the dielectric part reflects: head-on min(((ior - 1) / (ior + 1))^2 specular_color, 1)
    // specular, at grazing angles specular.
    float ior = 1.5F;                  // 1 and more; 0: infinite
    float specular = 1;                // 0..1
    glm::vec3 specular_color{1, 1, 1}; // linear; may exceed 1
    // Roughness is 1 - (1 - roughness) times A of the specular colour's texture.
    bool glossiness_texture = false;
    // coat and so on, a member a row.
#define FROXEL_MEMBER(type, name) io::type name;
    FROXEL_MATERIAL_FACTORS(FROXEL_MEMBER)
#undef FROXEL_MEMBER
    // base_color_texture and so on, a member a row.
#define FROXEL_SLOT(number, name, colour) TextureSlot name##_texture;
    FROXEL_MATERIAL_SLOTS(FROXEL_SLOT)
#undef FROXEL_SLOT
};

// All slots of a material, const or not, by their numbers.
template <class AnyMaterial>
[[nodiscard]] auto textureSlots(AnyMaterial& material) {
#define FROXEL_SLOT(number, name, colour) &material.name##_texture,
    return std::array{FROXEL_MATERIAL_SLOTS(FROXEL_SLOT)};
#undef FROXEL_SLOT
}

struct SlotRow {
    const char* name; // of Material's member
    bool srgb;
};
inline constexpr std::array kSlotRows = {
#define FROXEL_SLOT(number, name, colour) SlotRow{#name "_texture", (colour) != 0},
    FROXEL_MATERIAL_SLOTS(FROXEL_SLOT)
#undef FROXEL_SLOT
};
static_assert(kSlotRows.size() == io::kMaterialSlots, "kMaterialSlots counts the rows");
#define FROXEL_SLOT(number, name, colour) number,
static_assert(
    [] {
        size_t next = 0;
        return std::ranges::all_of(
            std::array<size_t, io::kMaterialSlots>{FROXEL_MATERIAL_SLOTS(FROXEL_SLOT)},
            [&](size_t number) { return number == next++; });
    }(),
    "slots' numbers ascend by 1 from 0");
static_assert(std::array{FROXEL_SURFACE_SLOTS(FROXEL_SLOT)}.size() == io::kSurfaceSlots,
              "kSurfaceSlots counts those of the surface");
#undef FROXEL_SLOT

// Takes the texture of one of its slots away, and what goes by it.
inline void clearTexture(Material& material, TextureSlot& slot) {
    slot = {};
    material.glossiness_texture =
        material.glossiness_texture && material.specular_color_texture.texture != kNone;
}

// A primitive's material in one of Scene::material_variants.
struct VariantMaterial {
    uint32_t variant = 0; // from 0
    uint32_t material = 0;
};

// Triangles of one material. Optional streams are empty or have one element per vertex.
struct Primitive {
    std::vector<glm::vec3> positions; // object space
    std::vector<glm::vec3> normals;   // unit; always filled (flat where the file has none)
    std::vector<glm::vec4> tangents;  // optional: xyz unit, w = handedness; else the shader derives
                                      // the frame from screen-space derivatives
    std::vector<glm::vec2> uv0;       // optional
    std::vector<glm::vec2> uv1;       // optional
    std::vector<glm::vec4> colors;    // optional: linear, 0..1
    std::vector<uint32_t> indices;    // three per triangle, each < positions.size()
    uint32_t material = 0;            // always valid
    std::vector<VariantMaterial> variant_materials; // by rising variant; in the others: material
    Bounds3 bounds;                                 // of positions
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

// One placed mesh; several instances share one copy of the geometry.
struct Instance {
    uint32_t mesh = 0;
    glm::dmat4 world_from_object{1}; // affine; may mirror and scale non-uniformly
    std::string name;                // of the node that places it
    uint32_t node = kNone;           // which of the file's; kNone: it is built in
};

struct NamedCamera {
    std::string name;
    settings::Camera camera;
};

enum class LightType : uint8_t { kPoint, kSpot, kDirectional };

// KHR_lights_punctual. Units: candela (point, spot), lux (directional).
// What a light shines from, ahead of it alone; the axes and the light's direction are
// perpendicular.
struct LightRectangle {
    glm::dvec3 half_right_world{0}; // m, from the centre to the middle of an edge
    glm::dvec3 half_up_world{0};    // -direction is right x up's
};

struct PunctualLight {
    std::string name;
    LightType type = LightType::kPoint;
    glm::dvec3 position_world{0, 0, 0};
    glm::dvec3 direction_world{0, 0, -1}; // unit, the way the light travels
    glm::vec3 color{1, 1, 1};             // linear
    float intensity = 1;
    float range_m = 0;         // 0: none given
    double inner_cone_rad = 0; // half angles; spot only
    double outer_cone_rad = 0.7853981633974483;
    std::optional<LightRectangle> rectangle; // of a spot of 90 degrees; no file has any
};

// Of glTF.
struct Extension {
    std::string name; // as the file has it
    bool read = false;
};

struct Scene {
    std::string name;
    uint64_t file_bytes = 0;        // of its file and of all that this refers to; 0: it is built in
    std::vector<StampedFile> files; // that reading it opened or looked for, its own first
    std::vector<Image> images;
    std::vector<Sampler> samplers;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    // KHR_materials_variants: their names, as the file has them: may be empty, may be another's.
    std::vector<std::string> material_variants;
    uint32_t material_variant = 0; // from 1, where nobody chose another; 0: none
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<NamedCamera> cameras;
    std::vector<PunctualLight> lights;
    BoundsD3 bounds_world;                // of all instances; empty for an empty scene
    std::shared_ptr<const Motion> motion; // scene/motion.h; null: all of the scene rests
    // Light from around that belongs to it (environment/surroundings.h); null: none does.
    std::shared_ptr<const environment::Surroundings> surroundings;
    std::vector<Extension> extensions; // that its file uses, by name
    std::vector<Warning> warnings;     // the gravest first; few, however many there are
    uint64_t warnings_left_out = 0;
};

} // namespace froxel::scene
