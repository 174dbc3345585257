#include "render/steps/shadow_maps.h"

#include "interface/constants.h"
#include "light/shadow_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace froxel::render {

namespace {

// Of the spheres' tests, for rounding.
constexpr double kSlack = 1e-4;
constexpr double kWidestFace_rad = 1.0471975511965976; // 60 degrees
constexpr double kNarrowestFace_rad = 0.01;

double farthestCorner(const BoundsD3& bounds, const glm::dvec3& from) {
    return bounds.empty()
               ? 0.0
               : glm::length(glm::max(glm::abs(bounds.min - from), glm::abs(bounds.max - from)));
}

// The greatest stretch of a vector, or a little more: the root of a norm of the Gram matrix.
double stretch(const glm::dmat3& m) {
    const glm::dmat3 gram = glm::transpose(m) * m;
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        most = std::max(most, std::abs(gram[i].x) + std::abs(gram[i].y) + std::abs(gram[i].z));
    }
    return std::sqrt(most);
}

glm::dmat3 axesAlong(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 up = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                          : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                               : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(up, direction));
    return {right, glm::cross(direction, right), direction};
}

bool castsShadows(const SceneResources& scene, const DrawItem& item) {
    if (!isSolid(item)) {
        return isTransmissive(item.material_flags);
    }
    const bool glows = scene.material_uniforms[item.primitive.material].emissive != glm::vec3(0) &&
                       (item.material_flags & textureFlag(io::emissive_slot)) == 0;
    return !glows;
}

// An item in a light's frame, lengths over its reach.
struct PlacedItem {
    glm::dmat3 linear{1};
    glm::dvec3 offset{0};
    double stretch = 1;

    [[nodiscard]] glm::dvec3 point(const glm::vec3& p) const {
        return linear * glm::dvec3(p) + offset;
    }
    [[nodiscard]] double length(float object) const {
        return static_cast<double>(object) * stretch;
    }
};

PlacedItem placeItem(const glm::dmat4& world_from_object, const ShadowPlace& place) {
    const glm::dmat3 light_from_world = glm::transpose(place.world_from_light) / place.reach_m;
    PlacedItem placed;
    placed.linear = light_from_world * glm::dmat3(world_from_object);
    placed.offset = light_from_world * (glm::dvec3(world_from_object[3]) - place.position_world);
    placed.stretch = stretch(placed.linear);
    return placed;
}

InstanceRows faceRows(const PlacedItem& item, uint32_t face, double scale) {
    const int axis = static_cast<int>(face / 2);
    const double forward = face % 2 == 0 ? 1.0 : -1.0;
    const auto row = [&](int i, double factor) {
        return glm::vec4(factor * glm::dvec4(item.linear[0][i], item.linear[1][i],
                                             item.linear[2][i], item.offset[i]));
    };
    // The rasteriser's passes look along -z.
    return {{row((axis + 1) % 3, scale), row((axis + 2) % 3, scale), row(axis, -forward)}};
}

// What one light's faces show.
class FaceDraws {
  public:
    FaceDraws(const SceneResources& scene,
              const ScenePose& pose,
              const ShadowPlace& place,
              ShadowFrame& out)
        : scene_(scene), instances_(pose.instances()), place_(place), out_(out) {}

    void add(const DrawItem& item) {
        const PlacedItem placed = placeItem(instances_[item.instance], place_);
        const auto& primitive = item.primitive;
        const uint32_t faces_of_all = facesOf(placed, primitive.center, primitive.radius);
        if (faces_of_all == 0) {
            return;
        }
        open_.fill({});
        const uint32_t end = primitive.first_meshlet + primitive.meshlet_count;
        for (uint32_t i = primitive.first_meshlet; i < end; ++i) {
            const Meshlet& meshlet = scene_.meshlets[i];
            const uint32_t faces =
                item.bends ? faces_of_all : facesOf(placed, meshlet.center, meshlet.radius);
            for (uint32_t face = firstFace(); face < endFace(); ++face) {
                if ((faces >> face & 1U) != 0) {
                    extend(item, placed, face, meshlet);
                }
            }
        }
        for (uint32_t face = firstFace(); face < endFace(); ++face) {
            close(item, face);
        }
    }

    // Appends the faces, the first of them as tile `tile`.
    void finish(uint32_t tile) {
        const size_t first = out_.faces.size();
        for (uint32_t face = firstFace(); face < endFace(); ++face) {
            auto& draws = draws_[face];
            std::stable_sort(draws.begin(), draws.end(), [](const Draw& a, const Draw& b) {
                return std::tuple(a.flags, a.material) < std::tuple(b.flags, b.material);
            });
            ShadowFace made{.tile = tile++,
                            .first_group = static_cast<uint32_t>(out_.groups.size())};
            for (const Draw& draw : draws) {
                const bool same = made.group_count > 0 &&
                                  out_.groups.back().material_flags == draw.flags &&
                                  out_.groups.back().material == draw.material;
                if (!same) {
                    out_.groups.push_back({draw.material, draw.flags,
                                           static_cast<uint32_t>(out_.commands.size()), 0});
                    ++made.group_count;
                }
                out_.commands.push_back(draw.command);
                made.bends = made.bends || draw.bends;
                transmits_ = transmits_ || isTransmissive(draw.flags);
                out_.triangle_count += draw.command.indexCount / 3;
                ++out_.groups.back().command_count;
            }
            out_.faces.push_back(made);
        }
        for (ShadowFace& face : std::span(out_.faces).subspan(first)) {
            face.transmits = transmits_;
        }
    }
    // Whether some casters of the faces let light pass.
    [[nodiscard]] bool transmits() const { return transmits_; }

  private:
    struct Draw {
        MaterialFlags flags = 0;
        uint32_t material = 0;
        bool bends = false;
        vk::DrawIndexedIndirectCommand command;
    };
    // The run of indices that an item's meshlets make in one face.
    struct Run {
        uint32_t first = 0;
        uint32_t end = 0;
        uint32_t row = io::kNoShadow; // none yet
    };

    // Of a spot only the face that it shines at.
    [[nodiscard]] uint32_t firstFace() const { return place_.face_count == 1 ? 4 : 0; }
    [[nodiscard]] uint32_t endFace() const { return firstFace() + place_.face_count; }

    [[nodiscard]] uint32_t
    facesOf(const PlacedItem& placed, const glm::vec3& center, float radius) const {
        const glm::dvec3 at = placed.point(center);
        const double grown = placed.length(radius) * (1 + kSlack) + kSlack * kSlack;
        uint32_t faces = 0;
        if (glm::dot(at, at) > (1 + grown) * (1 + grown)) {
            return faces;
        }
        for (uint32_t face = firstFace(); face < endFace(); ++face) {
            faces |= meetsFace(at, grown, face, place_.scale) ? 1U << face : 0U;
        }
        return faces;
    }

    void
    extend(const DrawItem& item, const PlacedItem& placed, uint32_t face, const Meshlet& meshlet) {
        Run& run = open_[face];
        if (run.row == io::kNoShadow) {
            run.row = static_cast<uint32_t>(out_.rows.size());
            out_.rows.push_back(faceRows(placed, face, place_.scale));
        }
        if (meshlet.first_index != run.end) {
            close(item, face);
            run.first = meshlet.first_index;
        }
        run.end = meshlet.first_index + meshlet.index_count;
    }

    void close(const DrawItem& item, uint32_t face) {
        const Run& run = open_[face];
        if (run.end == run.first) {
            return;
        }
        constexpr uint32_t kLookedAt = io::kMaterialMask | io::kMaterialTransmission;
        const bool looked_at = (item.material_flags & kLookedAt) != 0;
        draws_[face].push_back({looked_at ? item.material_flags : 0U,
                                looked_at ? item.primitive.material : 0U,
                                item.bends,
                                {.indexCount = run.end - run.first,
                                 .instanceCount = 1,
                                 .firstIndex = run.first,
                                 .vertexOffset = item.primitive.vertex_offset,
                                 .firstInstance = run.row}});
    }

    const SceneResources& scene_;
    const std::span<const glm::dmat4> instances_;
    const ShadowPlace& place_;
    ShadowFrame& out_;
    std::array<Run, 6> open_{};
    std::array<std::vector<Draw>, 6> draws_;
    bool transmits_ = false;
};

io::ShadowLight tableEntry(const io::Light& light,
                           const ShadowPlace& place,
                           const settings::Camera& camera,
                           uint32_t size_px,
                           uint32_t first_tile) {
    const glm::dmat3 view_from_world = glm::transpose(camera.world_from_view);
    const auto axis = [&](int i) { return glm::vec3(view_from_world * place.world_from_light[i]); };
    const auto size = static_cast<double>(size_px);
    return {.x_view = axis(0),
            .first_tile = static_cast<float>(first_tile),
            .y_view = axis(1),
            .face_count = static_cast<float>(place.face_count),
            .z_view = axis(2),
            .size_px = static_cast<float>(size_px),
            .position_view = light.position_view,
            .inv_radius2 = light.inv_radius2,
            .scale = static_cast<float>(place.scale),
            .texel = static_cast<float>(2.0 / (size * place.scale)),
            .near_m = static_cast<float>(static_cast<double>(io::kShadowNear) *
                                         static_cast<double>(io::kShadowSlack) * place.reach_m),
            .transmits = 0};
}

io::Frame mapUniforms() {
    io::Frame frame{};
    frame.camera.clip_scale = {1, 1};
    frame.camera.clip_z = {io::kShadowNear, 0}; // reversed-Z, infinite far
    frame.camera.clip_w = {0, -1};
    return frame;
}

// In either, commands count rows from the frame's first.
bool sameDraws(const ShadowFrame& a,
               const ShadowGroup& group_a,
               const ShadowFrame& b,
               const ShadowGroup& group_b) {
    if (group_a.material != group_b.material || group_a.material_flags != group_b.material_flags ||
        group_a.command_count != group_b.command_count) {
        return false;
    }
    for (uint32_t i = 0; i < group_a.command_count; ++i) {
        auto command_a = a.commands[group_a.first_command + i];
        auto command_b = b.commands[group_b.first_command + i];
        const uint32_t row_a = std::exchange(command_a.firstInstance, 0);
        const uint32_t row_b = std::exchange(command_b.firstInstance, 0);
        if (command_a != command_b ||
            std::memcmp(&a.rows[row_a], &b.rows[row_b], sizeof(InstanceRows)) != 0) {
            return false;
        }
    }
    return true;
}

} // namespace

bool sameFace(const ShadowFrame& a, const ShadowFrame& b, size_t face) {
    if (face >= a.faces.size() || face >= b.faces.size() ||
        std::memcmp(&a.uniforms, &b.uniforms, sizeof(io::Frame)) != 0) {
        return false;
    }
    const ShadowFace& face_a = a.faces[face];
    const ShadowFace& face_b = b.faces[face];
    if (face_a.tile != face_b.tile || face_a.group_count != face_b.group_count ||
        face_a.bends != face_b.bends || face_a.transmits != face_b.transmits) {
        return false;
    }
    for (uint32_t i = 0; i < face_a.group_count; ++i) {
        if (!sameDraws(a, a.groups[face_a.first_group + i], b, b.groups[face_b.first_group + i])) {
            return false;
        }
    }
    return true;
}

bool ShadowFrame::transmits() const {
    return std::ranges::any_of(faces, &ShadowFace::transmits);
}

void ShadowFrame::clear() {
    shadow_of_light.clear();
    lights.clear();
    faces.clear();
    groups.clear();
    rows.clear();
    commands.clear();
    triangle_count = 0;
}

ShadowPlace shadowPlace(const light::LightRig::Place& place, double reach_m, uint32_t size_px) {
    const auto size = static_cast<double>(size_px);
    ShadowPlace out{.position_world = place.position_world, .reach_m = reach_m};
    out.scale = (size - 2.0 * io::kShadowBorder) / size;
    if (place.outer_cone_rad && *place.outer_cone_rad <= kWidestFace_rad) {
        out.world_from_light = axesAlong(place.direction_world);
        out.face_count = 1;
        out.scale /= std::tan(std::max(*place.outer_cone_rad, kNarrowestFace_rad));
    }
    return out;
}

bool meetsFace(const glm::dvec3& center, double radius, uint32_t face, double scale) {
    const int axis = static_cast<int>(face / 2);
    const double along = face % 2 == 0 ? center[axis] : -center[axis];
    const double u = std::abs(center[(axis + 1) % 3]);
    const double v = std::abs(center[(axis + 2) % 3]);
    const double reach = radius * std::sqrt(1 + scale * scale);
    return along > -radius && along - scale * u > -reach && along - scale * v > -reach;
}

void buildShadows(const SceneResources& scene,
                  const ScenePose& pose,
                  const light::FrameLights& lights,
                  const settings::ViewSettings& settings,
                  double time_s,
                  ShadowFrame& out) {
    out.clear();
    const double diagonal_m = glm::length(pose.boundsWorld().size());
    const auto chosen = light::chooseShadowed(lights, settings.camera, settings.size, diagonal_m,
                                              settings.shadows.light_count);
    if (chosen.empty()) {
        return;
    }
    const uint32_t size_px = settings.shadows.size_px;
    out.shadow_of_light.assign(lights.lights.size(), io::kNoShadow);
    out.uniforms = mapUniforms();
    uint32_t tile = 0;
    for (const uint32_t index : chosen) {
        const auto at = pose.lightRig().placeOf(settings.lights, time_s, index);
        const double reach_m = std::min(static_cast<double>(lights.radii_m[index]),
                                        farthestCorner(pose.boundsWorld(), at.position_world));
        if (!(reach_m > 0)) {
            continue;
        }
        const ShadowPlace place = shadowPlace(at, reach_m, size_px);
        out.shadow_of_light[index] = static_cast<uint32_t>(out.lights.size());
        out.lights.push_back(
            tableEntry(lights.lights[index], place, settings.camera, size_px, tile));
        FaceDraws draws(scene, pose, place, out);
        for (const DrawItem& item : pose.items()) {
            if (castsShadows(scene, item)) {
                draws.add(item);
            }
        }
        draws.finish(tile);
        out.lights.back().transmits = draws.transmits() ? 1.0F : 0.0F;
        tile += place.face_count;
    }
}

} // namespace froxel::render
