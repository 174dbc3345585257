#include "render/view/visibility_readback.h"

#include "core/assert.h"
#include "render/frame/frame_slot.h"
#include "render/pipelines/host_copies.h"
#include "render/scene/geometry_pack.h"
#include "render/scene/scene_resources.h"
#include "render/scene/texture_store.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <unordered_map>
#include <utility>

namespace froxel::render {

namespace {

// Triangles by their corners; of equal ones, which look the same, the first.
using TriangleIndex = std::map<Corners, uint32_t>;

TriangleIndex indexTriangles(const scene::Primitive& primitive) {
    TriangleIndex index;
    for (uint32_t i = 0; 3 * size_t{i} < primitive.indices.size(); ++i) {
        const auto* corner = &primitive.indices[3 * size_t{i}];
        index.emplace(fromLowest({corner[0], corner[1], corner[2]}), i);
    }
    return index;
}

// From the ids of the visibility passes to the scene's own triangles.
class IdNames {
  public:
    IdNames(const scene::Scene& scene, const VisibilityScene& visibility)
        : scene_(scene), visibility_(visibility), geometry_(packGeometry(scene)) {}

    [[nodiscard]] VisibleTriangle name(uint32_t id) {
        const auto [found, fresh] = names_.try_emplace(id);
        if (fresh) {
            found->second = find(id);
        }
        return found->second;
    }

  private:
    [[nodiscard]] VisibleTriangle find(uint32_t id) {
        const auto& placed = visibility_.placed[id >> io::kTriangleBits];
        const uint32_t local = id & ((1U << io::kTriangleBits) - 1U);
        const uint32_t first = placed.first_index + 3 * local;
        const uint32_t instance = visibility_.item_instances[placed.item];
        const uint32_t mesh = scene_.instances[instance].mesh;
        const auto& packed = geometry_.meshes[mesh];
        const auto holds = [first](const PackedPrimitive& p) {
            return first >= p.first_index && first - p.first_index < p.index_count;
        };
        const auto found = std::find_if(packed.begin(), packed.end(), holds);
        FROXEL_ASSERT(found != packed.end(), "a meshlet belongs to a primitive of its mesh");
        const auto primitive = static_cast<uint32_t>(found - packed.begin());
        const auto* corner = &geometry_.triangles.indices[first];
        const auto& triangles = trianglesOf(mesh, primitive);
        const auto triangle = triangles.find(fromLowest({corner[0], corner[1], corner[2]}));
        FROXEL_ASSERT(triangle != triangles.end(), "packing makes no triangles");
        return {instance, primitive, triangle->second};
    }
    const TriangleIndex& trianglesOf(uint32_t mesh, uint32_t primitive) {
        const auto [found, fresh] = triangles_.try_emplace({mesh, primitive});
        if (fresh) {
            found->second = indexTriangles(scene_.meshes[mesh].primitives[primitive]);
        }
        return found->second;
    }

    const scene::Scene& scene_;
    const VisibilityScene& visibility_;
    const PackedGeometry geometry_;
    std::unordered_map<uint32_t, VisibleTriangle> names_;
    std::map<std::pair<uint32_t, uint32_t>, TriangleIndex> triangles_; // by mesh and primitive
};

} // namespace

Visibility copyVisibility(SceneResources& resources,
                          MaterialSet& material_set,
                          const ViewTargets& targets,
                          const scene::Scene& scene) {
    const size_t count = size_t{targets.size.drawn.width_px} * targets.size.drawn.height_px;
    Visibility visibility{targets.size.drawn.width_px,
                          targets.size.drawn.height_px,
                          {},
                          {},
                          textureFilter(resources.shared.device)};
    visibility.pixels.resize(count);
    visibility.depths.resize(count);
    if (!targets.needs.visibility) {
        return visibility; // no solid surface in the whole scene
    }
    const Readback readback(resources.shared.device,
                            {.picture = count * (sizeof(uint32_t) + sizeof(float))});
    resources.shared.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        recordTargetCopy(cmd, targets.ids, vk::ImageAspectFlagBits::eColor, readback.buffer);
        recordTargetCopy(cmd, targets.solidDepth(),
                         targets.rastered_in_compute ? vk::ImageAspectFlagBits::eColor
                                                     : vk::ImageAspectFlagBits::eDepth,
                         readback.buffer, count * sizeof(uint32_t));
    });
    IdNames names(scene, material_set.visibility());
    const std::byte* ids = readback.buffer.mapped;
    const std::byte* depths = ids + count * sizeof(uint32_t);
    for (size_t i = 0; i < count; ++i) {
        uint32_t id = 0;
        float depth = 0;
        std::memcpy(&id, ids + i * sizeof(id), sizeof(id));
        std::memcpy(&depth, depths + i * sizeof(depth), sizeof(depth));
        visibility.depths[i] = depth;
        if (depth > 0) { // ids of empty pixels say nothing
            visibility.pixels[i] = names.name(id);
        }
    }
    return visibility;
}

Result<Visibility>
readVisibility(Renderer& renderer, const scene::Scene& scene, FrameInputs inputs) {
    settings::ViewSettings plain; // nothing but surfaces
    plain.camera = inputs.settings.camera;
    plain.size = inputs.settings.size;
    plain.material_variant = inputs.settings.material_variant;
    plain.shading = settings::ShadingModel::kLambert;
    plain.lights.count = 0;
    plain.lights.scene_lights = false;
    inputs.settings = plain;
    inputs.geometry = GeometryPath::kVisibility;
    ViewRenderer view(renderer);
    if (const auto submitted = view.submit(inputs); !submitted) {
        return submitted.error();
    }
    if (const auto frame = view.collect(); !frame) {
        return frame.error();
    }
    return view.readVisibility(scene);
}

} // namespace froxel::render
