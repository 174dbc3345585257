#include "render/frame/draw_list.h"

#include "core/parallel.h"
#include "interface/constants.h"
#include "render/frame/covered_part.h"
#include "render/frame/detail_choice.h"
#include "render/frame/triangle_cull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <span>
#include <tuple>

namespace froxel::render {

namespace {

// Spheres are tested with this share of slack, for the float planes.
constexpr float kSlack = 1e-4F;

// One item's view of the camera, in its own object space: meshlets need no transform.
struct ObjectView {
    std::array<glm::vec4, 5> planes; // inside where dot(xyz, p) + w >= 0; not normalised
    std::array<float, 5> lengths;    // of the planes' normals
    glm::vec3 eye{0};
    bool cones = false; // back-facing meshlets may go

    [[nodiscard]] bool outside(const glm::vec3& center, float radius) const {
        const float grown = radius * (1 + kSlack) + kSlack * 1e-2F;
        for (size_t i = 0; i < planes.size(); ++i) {
            const float d = glm::dot(glm::vec3(planes[i]), center) + planes[i].w;
            if (d < -grown * lengths[i]) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] bool facesAway(const Meshlet& m) const {
        if (!cones || m.cone_cutoff >= 1) {
            return false;
        }
        const glm::vec3 toward = m.center - eye;
        return glm::dot(toward, m.cone_axis) >=
               m.cone_cutoff * glm::length(toward) + m.radius * (1 + kSlack) + kSlack;
    }
};

// Rows of clip_from_view, for planes and for triangles.
glm::mat4 clipFromView(const settings::Camera& camera, const ViewProjection& projection) {
    const bool perspective = camera.projection == settings::Projection::kPerspective;
    glm::mat4 m(0.0F);
    m[0][0] = static_cast<float>(projection.clip_scale.x);
    m[1][1] = static_cast<float>(projection.clip_scale.y);
    glm::vec4& carries_w = perspective ? m[2] : m[3];
    const glm::vec2 offset(projection.clip_offset);
    carries_w.x = perspective ? -offset.x : offset.x;
    carries_w.y = perspective ? -offset.y : offset.y;
    m[2][2] = 0;
    m[3][2] = static_cast<float>(camera.near_m);
    m[2][3] = perspective ? -1.0F : 0.0F;
    m[3][3] = perspective ? 0.0F : 1.0F;
    return m;
}

glm::vec4 row(const glm::mat4& m, int i) {
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

void eraseEmpty(std::vector<DrawGroup>& groups) {
    std::erase_if(groups, [](const DrawGroup& group) { return group.command_count == 0; });
}

// A visible meshlet with what it is sorted by.
struct Visible {
    uint32_t bucket; // of distance, near ones first
    uint32_t item;
    uint32_t meshlet;
};

// Buckets of distance: four an octave, from 1 mm.
uint32_t distanceBucket(float distance_m) {
    const float octaves = std::log2(std::max(distance_m, 1e-3F)) - std::log2(1e-3F);
    return static_cast<uint32_t>(octaves * 4);
}

// Neighbouring meshlets that make one draw, and their place in the culled indices.
struct Run {
    std::span<const Visible> meshlets;
    size_t meshlets_before; // of the runs before it
    size_t thread = 0;      // that culls it
    uint32_t first = 0;
    uint32_t end = 0;
};

// Of a run at most, so that threads get equal shares.
constexpr size_t kMostOfRun = 256;
// Culled by triangle, they keep a thread busy for longer than its start takes.
constexpr size_t kLeastOfThread = 256;

template <class Same>
std::vector<Run> splitRuns(std::span<const Visible> visible, Same same) {
    std::vector<Run> runs;
    for (size_t first = 0; first < visible.size();) {
        const size_t most = std::min(visible.size(), first + kMostOfRun);
        size_t end = first + 1;
        while (end < most && same(visible[first], visible[end])) {
            ++end;
        }
        runs.push_back({visible.subspan(first, end - first), first});
        first = end;
    }
    return runs;
}

class Builder {
  public:
    Builder(const SceneResources& scene,
            const ScenePose& pose,
            const settings::Camera& camera,
            const settings::Size& size,
            const ViewProjection& projection,
            float geometry_error_px,
            bool by_triangle,
            DrawList& out)
        : scene_(scene), instances_(pose.instances()), items_(pose.items()), camera_(camera),
          size_(size), projection_(projection), geometry_error_px_(geometry_error_px),
          by_triangle_(by_triangle), clip_from_view_(clipFromView(camera, projection)),
          half_size_px_(glm::vec2(size.width_px, size.height_px) * 0.5F), out_(out) {}

    void build(bool solid_wanted, TransparentOrder order);

  private:
    void placeInstances();
    [[nodiscard]] ObjectView objectView(const DrawItem& item) const;
    [[nodiscard]] glm::mat4 viewFromObject(const DrawItem& item) const;
    [[nodiscard]] TriangleCull triangleCull(const DrawItem& item) const;
    [[nodiscard]] float distance(const DrawItem& item, const glm::vec3& center) const;
    void collect(uint32_t item_index, std::vector<Visible>& visible) const;
    void addSolid(std::vector<Visible>& visible);
    void addLayered(std::vector<Visible>& visible, TransparentOrder order, LayeredDraws& draws);
    void openGroup(const DrawItem& item, std::vector<DrawGroup>& groups);
    void cullRun(Run& run, std::vector<uint32_t>& indices) const;
    void cullRuns(std::span<Run> runs);
    void addRuns(std::vector<Run> runs, std::vector<DrawGroup>& groups);
    void addMeshlets(const DrawItem& item, std::span<const Visible> meshlets, DrawGroup& group);
    void addCommand(const DrawItem& item, uint32_t first, uint32_t end, DrawGroup& group);
    [[nodiscard]] vk::Rect2D partOf(const Visible& visible, float grown_by = 0) const;

    const SceneResources& scene_; // what rests of it
    const std::span<const glm::dmat4> instances_;
    const std::span<const DrawItem> items_;
    const settings::Camera& camera_;
    const settings::Size& size_;
    const ViewProjection& projection_;
    const float geometry_error_px_;
    const bool by_triangle_;
    const glm::mat4 clip_from_view_;
    const glm::vec2 half_size_px_;
    DrawList& out_;
};

// view_from_object in double, relative to the eye, then rounded once.
void Builder::placeInstances() {
    const glm::dmat3 view_from_world = glm::transpose(camera_.world_from_view);
    out_.rows.resize(instances_.size());
    for (size_t i = 0; i < instances_.size(); ++i) {
        const glm::dmat4& world = instances_[i];
        const glm::dmat3 linear = view_from_world * glm::dmat3(world);
        const glm::dvec3 offset = view_from_world * (glm::dvec3(world[3]) - camera_.eye_world);
        for (int r = 0; r < 3; ++r) {
            out_.rows[i].row[r] = glm::vec4(linear[0][r], linear[1][r], linear[2][r], offset[r]);
        }
    }
}

glm::mat4 Builder::viewFromObject(const DrawItem& item) const {
    const auto& rows = out_.rows[item.instance].row;
    return glm::transpose(glm::mat4(rows[0], rows[1], rows[2], glm::vec4(0, 0, 0, 1)));
}

ObjectView Builder::objectView(const DrawItem& item) const {
    const glm::mat4 view_from_object = viewFromObject(item);
    const glm::mat4 clip = clip_from_view_ * view_from_object;
    const glm::vec4 w = row(clip, 3);
    const glm::vec4 ahead = -row(view_from_object, 2);
    ObjectView v;
    v.planes = {w + row(clip, 0), w - row(clip, 0), w + row(clip, 1), w - row(clip, 1),
                ahead - glm::vec4(0, 0, 0, static_cast<float>(camera_.near_m) * (1 - kSlack))};
    for (size_t i = 0; i < v.planes.size(); ++i) {
        v.lengths[i] = glm::length(glm::vec3(v.planes[i]));
    }
    v.cones = camera_.projection == settings::Projection::kPerspective &&
              (item.material_flags & io::kMaterialDoubleSided) == 0;
    if (v.cones) {
        const glm::dmat4& world = instances_[item.instance];
        v.eye = glm::inverse(glm::dmat3(world)) * (camera_.eye_world - glm::dvec3(world[3]));
        v.cones = glm::all(glm::lessThan(glm::abs(v.eye), glm::vec3(1e6F))); // singular: keep all
    }
    return v;
}

TriangleCull Builder::triangleCull(const DrawItem& item) const {
    return {.clip_from_object = clip_from_view_ * viewFromObject(item),
            .half_size_px = half_size_px_,
            .cull_back = (item.material_flags & io::kMaterialDoubleSided) == 0,
            .mirrored = item.mirrored};
}

float Builder::distance(const DrawItem& item, const glm::vec3& center) const {
    const auto& rows = out_.rows[item.instance].row;
    const glm::vec4 p(center, 1.0F);
    return glm::length(glm::vec3(glm::dot(rows[0], p), glm::dot(rows[1], p), glm::dot(rows[2], p)));
}

void Builder::collect(uint32_t item_index, std::vector<Visible>& visible) const {
    const DrawItem& item = items_[item_index];
    const ObjectView v = objectView(item);
    if (v.outside(item.primitive.center, item.primitive.radius)) {
        return;
    }
    const uint32_t end = item.primitive.first_meshlet + item.primitive.meshlet_count;
    if (item.bends) {
        const uint32_t bucket = distanceBucket(distance(item, item.primitive.center));
        for (uint32_t i = item.primitive.first_meshlet; i < end; ++i) {
            visible.push_back({bucket, item_index, i});
        }
        return;
    }
    const auto take = [&](uint32_t i) {
        const Meshlet& m = scene_.meshlets[i];
        if (!v.outside(m.center, m.radius) && !v.facesAway(m)) {
            visible.push_back({distanceBucket(distance(item, m.center)), item_index, i});
        }
    };
    if (geometry_error_px_ == 0 || item.primitive.coarser_meshlet_count == 0) {
        for (uint32_t i = item.primitive.first_meshlet; i < end; ++i) {
            take(i);
        }
        return;
    }
    const DetailChoice choice(geometry_error_px_, camera_, size_, projection_,
                              viewFromObject(item));
    const auto takeDrawn = [&](uint32_t first, uint32_t count) {
        for (uint32_t i = first; i < first + count; ++i) {
            if (choice.draws(scene_.details[i])) {
                take(i);
            }
        }
    };
    takeDrawn(item.primitive.first_meshlet, item.primitive.meshlet_count);
    takeDrawn(item.primitive.first_coarser_meshlet, item.primitive.coarser_meshlet_count);
}

void Builder::openGroup(const DrawItem& item, std::vector<DrawGroup>& groups) {
    const uint32_t material = item.primitive.material;
    if (groups.empty() || groups.back().material != material ||
        groups.back().material_flags != item.material_flags ||
        groups.back().mirrored != item.mirrored) {
        groups.push_back({material, item.material_flags, item.mirrored,
                          static_cast<uint32_t>(out_.commands.size()), 0});
    }
}

void Builder::addCommand(const DrawItem& item, uint32_t first, uint32_t end, DrawGroup& group) {
    if (end == first) {
        return;
    }
    out_.commands.push_back({.indexCount = end - first,
                             .instanceCount = 1,
                             .firstIndex = first,
                             .vertexOffset = item.primitive.vertex_offset,
                             .firstInstance = item.instance});
    out_.triangle_count += (end - first) / 3;
    ++group.command_count;
}

// Appends the run's indices, culled triangle by triangle.
void Builder::cullRun(Run& run, std::vector<uint32_t>& indices) const {
    const DrawItem& item = items_[run.meshlets.front().item];
    const TriangleCull cull = triangleCull(item);
    const auto positions =
        std::span(scene_.positions).subspan(static_cast<size_t>(item.primitive.vertex_offset));
    run.first = static_cast<uint32_t>(indices.size());
    for (const Visible& v : run.meshlets) {
        const Meshlet& m = scene_.meshlets[v.meshlet];
        const MeshletTriangles triangles(m, scene_.meshlet_words);
        if (!item.bends) {
            appendVisibleTriangles(cull, triangles, positions, indices);
            continue;
        }
        for (const uint32_t triangle : triangles.triangles) {
            for (const uint32_t corner : {0U, 1U, 2U}) {
                indices.push_back(triangles.vertices[localVertex(triangle, corner)]);
            }
        }
    }
    run.end = static_cast<uint32_t>(indices.size());
}

// Culls all runs into DrawList::indices. Each thread takes neighbouring runs.
void Builder::cullRuns(std::span<Run> runs) {
    const size_t count = runs.back().meshlets_before + runs.back().meshlets.size();
    const size_t threads = threadCount(count, kLeastOfThread);
    const auto runAt = [&](size_t meshlet) {
        return std::ranges::lower_bound(runs, meshlet, {}, &Run::meshlets_before);
    };
    auto& parts = out_.thread_indices;
    parts.resize(std::max(parts.size(), threads));
    onThreads(count, threads, [&](size_t thread, size_t begin, size_t end) {
        parts[thread].clear();
        for (Run& run : std::ranges::subrange(runAt(begin), runAt(end))) {
            run.thread = thread;
            cullRun(run, parts[thread]);
        }
    });
    std::vector<uint32_t> offsets;
    for (const auto& part : std::span(parts).first(threads)) {
        offsets.push_back(static_cast<uint32_t>(out_.indices.size()));
        out_.indices.insert(out_.indices.end(), part.begin(), part.end());
    }
    for (Run& run : runs) {
        run.first += offsets[run.thread];
        run.end += offsets[run.thread];
    }
}

void Builder::addRuns(std::vector<Run> runs, std::vector<DrawGroup>& groups) {
    if (by_triangle_ && !runs.empty()) {
        cullRuns(runs);
    }
    for (const Run& run : runs) {
        const DrawItem& item = items_[run.meshlets.front().item];
        openGroup(item, groups);
        if (by_triangle_) {
            addCommand(item, run.first, run.end, groups.back());
        } else {
            addMeshlets(item, run.meshlets, groups.back());
        }
    }
}

// Meshlets of one item, in index order, as runs of the scene's own index list.
void Builder::addMeshlets(const DrawItem& item,
                          std::span<const Visible> meshlets,
                          DrawGroup& group) {
    uint32_t first = 0;
    uint32_t end = 0;
    for (const Visible& v : meshlets) {
        const Meshlet& m = scene_.meshlets[v.meshlet];
        if (m.first_index != end) {
            addCommand(item, first, end, group);
            first = m.first_index;
        }
        end = m.first_index + m.index_count;
    }
    addCommand(item, first, end, group);
}

// Near buckets first, so that the depth test spares what lies behind; in a bucket by material.
void Builder::addSolid(std::vector<Visible>& visible) {
    const auto key = [&](const Visible& v) {
        const DrawItem& item = items_[v.item];
        return std::tuple(v.bucket, item.primitive.material, item.material_flags, item.mirrored,
                          v.item, v.meshlet);
    };
    std::sort(visible.begin(), visible.end(),
              [&](const Visible& a, const Visible& b) { return key(a) < key(b); });
    addRuns(splitRuns(visible,
                      [](const Visible& x, const Visible& y) {
                          return x.item == y.item && x.bucket == y.bucket;
                      }),
            out_.solid);
    eraseEmpty(out_.solid);
}

// grown_by: in object space.
vk::Rect2D Builder::partOf(const Visible& visible, float grown_by) const {
    const DrawItem& item = items_[visible.item];
    const Meshlet& m = scene_.meshlets[visible.meshlet];
    const glm::vec3 center = item.bends ? item.primitive.center : m.center;
    const float radius = item.bends ? item.primitive.radius : m.radius;
    const glm::mat4 view_from_object = viewFromObject(item);
    const float scale = std::max({glm::length(glm::vec3(view_from_object[0])),
                                  glm::length(glm::vec3(view_from_object[1])),
                                  glm::length(glm::vec3(view_from_object[2]))});
    return coveredPart(clip_from_view_, glm::vec3(view_from_object * glm::vec4(center, 1.0F)),
                       (radius + grown_by) * scale, half_size_px_);
}

// Whole items: blending needs order more than it needs few draws.
void Builder::addLayered(std::vector<Visible>& visible,
                         TransparentOrder order,
                         LayeredDraws& draws) {
    const auto before = [&](const Visible& a, const Visible& b) {
        const auto key = [&](const Visible& v) {
            const DrawItem& item = items_[v.item];
            const float nearness = order == TransparentOrder::kByDistance
                                       ? -distance(item, item.primitive.center)
                                       : 0.0F;
            return std::tuple(nearness, v.item, v.meshlet);
        };
        return key(a) < key(b);
    };
    std::sort(visible.begin(), visible.end(), before);
    const uint32_t count_before = out_.triangle_count;
    addRuns(splitRuns(visible, [](const Visible& x, const Visible& y) { return x.item == y.item; }),
            draws.groups);
    draws.triangle_count = out_.triangle_count - count_before;
    for (const Visible& v : visible) {
        draws.parts.push_back(partOf(v));
        const DrawItem& item = items_[v.item];
        if (isTransmissive(item.material_flags)) {
            const auto& material = scene_.material_uniforms[item.primitive.material];
            draws.seen_parts.push_back(partOf(v, material.volume.thickness_m));
        }
    }
    eraseEmpty(draws.groups);
}

void Builder::build(bool solid_wanted, TransparentOrder order) {
    placeInstances();
    std::vector<Visible> solid;
    std::vector<Visible> transparent;
    std::vector<Visible> transmissive;
    for (uint32_t i = 0; i < items_.size(); ++i) {
        if (isTransmissive(items_[i].material_flags)) {
            collect(i, transmissive);
        } else if (!isSolid(items_[i])) {
            collect(i, transparent);
        } else if (solid_wanted) {
            collect(i, solid);
        }
    }
    addSolid(solid);
    addLayered(transparent, order, out_.transparent);
    addLayered(transmissive, TransparentOrder::kOfTheScene, out_.transmissive);
}

} // namespace

void buildDrawList(const SceneResources& scene,
                   const ScenePose& pose,
                   const settings::Camera& camera,
                   const settings::Size& size,
                   const ViewProjection& projection,
                   float geometry_error_px,
                   bool by_triangle,
                   bool solid,
                   TransparentOrder order,
                   DrawList& out) {
    out.commands.clear();
    out.solid.clear();
    out.transparent.clear();
    out.transmissive.clear();
    out.indices.clear();
    out.triangle_count = 0;
    Builder(scene, pose, camera, size, projection, geometry_error_px, by_triangle, out)
        .build(solid, order);
}

} // namespace froxel::render
