// The members of a scene's structs, in the order in which they are written, and which values their
// enumerations have.
#pragma once

#include "bake/fields.h"
#include "scene/motion.h"
#include "scene/scene.h"

#include <tuple>
#include <type_traits>

namespace froxel::bake {

template <>
inline constexpr bool kAnyBits<scene::VariantMaterial> = true;
template <>
inline constexpr bool kAnyBits<scene::Influence> = true;
template <>
inline constexpr bool kAnyBits<scene::MorphDelta> = true;
template <>
inline constexpr bool kAnyBits<scene::MovedThing> = true;
#define FROXEL_FACTORS(type, name)                                                                 \
    template <>                                                                                    \
    inline constexpr bool kAnyBits<io::type> = true;
FROXEL_MATERIAL_FACTORS(FROXEL_FACTORS)
#undef FROXEL_FACTORS
template <>
struct Values<scene::Wrap>
    : ValuesFrom<scene::Wrap, scene::Wrap::kRepeat, scene::Wrap::kClampToEdge> {};
template <>
struct Values<scene::Filter>
    : ValuesFrom<scene::Filter, scene::Filter::kNearest, scene::Filter::kLinear> {};
template <>
struct Values<scene::AlphaMode>
    : ValuesFrom<scene::AlphaMode, scene::AlphaMode::kOpaque, scene::AlphaMode::kBlend> {};
template <>
struct Values<scene::LightType>
    : ValuesFrom<scene::LightType, scene::LightType::kPoint, scene::LightType::kDirectional> {};
template <>
struct Values<scene::Interpolation> : ValuesFrom<scene::Interpolation,
                                                 scene::Interpolation::kStep,
                                                 scene::Interpolation::kCubicSpline> {};
template <>
struct Values<scene::ChannelPath> : ValuesFrom<scene::ChannelPath,
                                               scene::ChannelPath::kTranslation,
                                               scene::ChannelPath::kWeights> {};
template <>
struct Values<scene::Severity>
    : ValuesFrom<scene::Severity, scene::Severity::kWarning, scene::Severity::kInformation> {};
template <>
struct Values<settings::Projection> : ValuesFrom<settings::Projection,
                                                 settings::Projection::kPerspective,
                                                 settings::Projection::kOrthographic> {};

FROXEL_FIELDS(Bounds3, 0, v.min, v.max)
FROXEL_FIELDS(BoundsD3, 0, v.min, v.max)
FROXEL_FIELDS(scene::Sampler, 0, v.wrap_u, v.wrap_v, v.mag, v.min, v.mip, v.mipmapped)
FROXEL_FIELDS(scene::Image, 0, v.name, v.width_px, v.height_px, v.rgba8, v.mips)
FROXEL_FIELDS(scene::Texture, 0, v.image, v.sampler)
FROXEL_FIELDS(scene::TextureSlot, 0, v.texture, v.texcoord, v.offset, v.rotation_rad, v.scale)
FROXEL_FIELDS(scene::Primitive,
              0,
              v.positions,
              v.normals,
              v.tangents,
              v.uv0,
              v.uv1,
              v.colors,
              v.indices,
              v.material,
              v.variant_materials,
              v.bounds)
FROXEL_FIELDS(scene::Mesh, 0, v.name, v.primitives)
FROXEL_FIELDS(scene::Instance, 0, v.mesh, v.world_from_object, v.name, v.node)
FROXEL_FIELDS(settings::Camera,
              0,
              v.eye_world,
              v.world_from_view,
              v.projection,
              v.yfov_rad,
              v.half_height_m,
              v.lens_shift,
              v.near_m,
              v.focus_m)
FROXEL_FIELDS(scene::NamedCamera, 0, v.name, v.camera)
FROXEL_FIELDS(scene::LightRectangle, 0, v.half_right_world, v.half_up_world)
FROXEL_FIELDS(scene::PunctualLight,
              0,
              v.name,
              v.type,
              v.position_world,
              v.direction_world,
              v.color,
              v.intensity,
              v.range_m,
              v.inner_cone_rad,
              v.outer_cone_rad,
              v.rectangle)
FROXEL_FIELDS(scene::Warning, 0, v.code, v.severity, v.pointer, v.message)
FROXEL_FIELDS(scene::Transform, 0, v.translation, v.rotation, v.scale)
FROXEL_FIELDS(scene::Track, 0, v.interpolation, v.width, v.times_s, v.values)
FROXEL_FIELDS(scene::Channel, 0, v.track, v.node, v.path)
FROXEL_FIELDS(scene::Clip, 0, v.name, v.duration_s, v.tracks, v.channels)
FROXEL_FIELDS(scene::Node, 0, v.parent, v.rest, v.matrix, v.first_weight, v.weight_count)
FROXEL_FIELDS(scene::Skin, 0, v.name, v.joints, v.joint_from_object)
FROXEL_FIELDS(
    scene::Deformation, 0, v.first_influence, v.influences, v.first_delta, v.deltas, v.flat_normals)
FROXEL_FIELDS(scene::DeformedMesh, 0, v.mesh, v.node, v.skin, v.deformations)
FROXEL_FIELDS(scene::MovedInstance, 0, v.instance, v.node, v.node_from_object, v.deformed)
FROXEL_FIELDS(scene::Motion,
              0,
              v.nodes,
              v.rest_weights,
              v.skins,
              v.deformed,
              v.instances,
              v.lights,
              v.cameras,
              v.clips,
              v.played)
FROXEL_FIELDS(scene::Extension, 0, v.name, v.read)
// Not the files, which whoever opened them knows, nor surroundings, which no file has.
FROXEL_FIELDS(scene::Scene,
              2,
              v.name,
              v.file_bytes,
              v.images,
              v.samplers,
              v.textures,
              v.materials,
              v.material_variants,
              v.material_variant,
              v.meshes,
              v.instances,
              v.cameras,
              v.lights,
              v.bounds_world,
              v.motion,
              v.extensions,
              v.warnings,
              v.warnings_left_out)

template <>
struct Fields<scene::Material> {
    template <class Value>
    static auto of(Value& v) {
#define FROXEL_MEMBER(type, name) , v.name
#define FROXEL_SLOT(number, name, colour) , v.name##_texture
        const auto all = std::tie(v.name, v.base_color, v.metallic, v.roughness, v.normal_scale,
                                  v.occlusion_strength, v.emissive, v.alpha_mode, v.alpha_cutoff,
                                  v.double_sided, v.unlit, v.ior, v.specular, v.specular_color,
                                  v.glossiness_texture FROXEL_MATERIAL_FACTORS(FROXEL_MEMBER)
                                      FROXEL_MATERIAL_SLOTS(FROXEL_SLOT));
#undef FROXEL_SLOT
#undef FROXEL_MEMBER
        static_assert(std::tuple_size_v<std::remove_const_t<decltype(all)>> ==
                          detail::memberCount<scene::Material>(),
                      "every member is listed");
        return all;
    }
};

} // namespace froxel::bake
