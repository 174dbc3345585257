#include "render/frame/visibility_instances.h"

#include <array>
#include <bit>
#include <numeric>

namespace froxel::render {

namespace {

// Eight an octave of distance: the exponent of its square and two bits more.
constexpr uint32_t kBuckets = 1U << 10U;

uint32_t bucketOf(const glm::vec3& center, const InstanceRows& rows) {
    const glm::vec4 p(center, 1.0F);
    const glm::vec3 view(glm::dot(rows.row[0], p), glm::dot(rows.row[1], p),
                         glm::dot(rows.row[2], p));
    return std::bit_cast<uint32_t>(glm::dot(view, view)) >> 21U & (kBuckets - 1);
}

} // namespace

void placeInstances(std::span<const glm::dmat4> world_from_objects,
                    const settings::Camera& camera,
                    std::span<const InstanceRows> rows,
                    std::vector<io::InstanceView>& out) {
    out.resize(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
        const glm::dmat4& world = world_from_objects[i];
        const glm::dmat3 linear(world);
        // Of a flattened instance the eye has no place in object space; shaders take what is far
        // away as unknown.
        const glm::dvec3 eye = glm::inverse(linear) * (camera.eye_world - glm::dvec3(world[3]));
        const bool known = glm::all(glm::lessThan(glm::abs(eye), glm::dvec3(1e30)));
        out[i] = {rows[i].row[0], rows[i].row[1], rows[i].row[2],
                  known ? glm::vec3(eye) : glm::vec3(1e30F),
                  glm::determinant(linear) < 0 ? 1U : 0U};
    }
}

void orderMeshlets(const VisibilityScene& visibility,
                   std::span<const Meshlet> meshlets,
                   std::span<const InstanceRows> rows,
                   std::vector<uint32_t>& order) {
    const auto& placed = visibility.placed;
    if (!visibility.ordered()) {
        order.clear();
        return;
    }
    order.resize(placed.size());
    for (const auto& group : visibility.groups) {
        const size_t first = size_t{group.blocks.first_block} * io::kCullGroup;
        const size_t end = first + size_t{group.blocks.block_count} * io::kCullGroup;
        const auto bucket = [&](size_t i) {
            const auto& [item, meshlet, first_index] = placed[i];
            return meshlet == io::kNoMeshlet
                       ? kBuckets - 1
                       : bucketOf(meshlets[meshlet].center, rows[visibility.item_instances[item]]);
        };
        std::array<uint32_t, kBuckets + 1> starts{};
        for (size_t i = first; i < end; ++i) {
            ++starts[bucket(i) + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        for (size_t i = first; i < end; ++i) {
            order[first + starts[bucket(i)]++] = static_cast<uint32_t>(i);
        }
    }
}

} // namespace froxel::render
