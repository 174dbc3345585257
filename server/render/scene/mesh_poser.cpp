#include "render/scene/mesh_poser.h"

#include "render/scene/scene_resources.h"
#include "scene/motion.h"

#include <algorithm>
#include <array>
#include <span>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

// Rows of all primitives that bend, one after another.
struct PoseTables {
    std::vector<io::PoseRange> ranges;
    std::vector<io::PoseInfluence> influences;
    std::vector<io::PoseDelta> deltas;

    // Returns where its ranges begin.
    uint32_t add(const scene::Deformation& deformation, size_t vertex_count) {
        const auto first = static_cast<uint32_t>(ranges.size());
        const auto at = [](const std::vector<uint32_t>& starts, size_t vertex, size_t before) {
            return static_cast<uint32_t>(before + (starts.empty() ? 0 : starts[vertex]));
        };
        for (size_t v = 0; v <= vertex_count; ++v) {
            ranges.push_back({at(deformation.first_influence, v, influences.size()),
                              at(deformation.first_delta, v, deltas.size())});
        }
        for (const scene::Influence& influence : deformation.influences) {
            influences.push_back({influence.joint, influence.weight});
        }
        for (const scene::MorphDelta& delta : deformation.deltas) {
            deltas.push_back({delta.target, delta.position, delta.normal, delta.tangent});
        }
        return first;
    }
};

PoseTables tablesOf(const scene::Scene& scene,
                    const PackedGeometry& geometry,
                    std::vector<io::PoseJob>& jobs) {
    PoseTables tables;
    uint32_t joint_count = 0;
    for (const scene::DeformedMesh& deformed : scene.motion->deformed) {
        const bool skinned = deformed.skin != scene::kNone;
        for (size_t p = 0; p < deformed.deformations.size(); ++p) {
            const scene::Deformation& deformation = deformed.deformations[p];
            const auto& source = scene.meshes[deformed.mesh].primitives[p];
            const PackedPrimitive& packed = geometry.meshes[deformed.mesh][p];
            if (source.positions.empty()) {
                continue;
            }
            const bool follows = skinned && !deformation.first_influence.empty();
            jobs.push_back({.first_vertex = static_cast<uint32_t>(packed.vertex_offset),
                            .vertex_count = static_cast<uint32_t>(source.positions.size()),
                            .first_range = tables.add(deformation, source.positions.size()),
                            .first_joint = follows ? joint_count : io::kNoSkin,
                            .first_weight = scene.motion->nodes[deformed.node].first_weight,
                            .tangents = packed.tangents ? 1U : 0U,
                            .first_index = packed.first_index,
                            .flat_count = deformation.flat_normals ? packed.index_count / 3 : 0});
        }
        joint_count +=
            skinned ? static_cast<uint32_t>(scene.motion->skins[deformed.skin].joints.size()) : 0;
    }
    return tables;
}

template <class T>
gpu::Buffer
upload(gpu::MemoryArena& arena, gpu::Uploader& uploader, std::vector<T> table, const char* name) {
    table.resize(std::max<size_t>(table.size(), 1)); // a buffer has bytes
    return gpu::makeFilled(arena, uploader, std::move(table), Usage::eStorageBuffer, name);
}

gpu::Buffer copyOf(gpu::MemoryArena& arena, const gpu::Buffer& source) {
    return *source.handle ? arena.makeBuffer(source.size_bytes,
                                             Usage::eVertexBuffer | Usage::eStorageBuffer |
                                                 Usage::eTransferDst | Usage::eTransferSrc,
                                             gpu::MemoryUse::kDevice, "posed vertices")
                          : gpu::Buffer{};
}

void dispatchFor(const vk::raii::CommandBuffer& cmd, uint32_t count) {
    constexpr uint32_t kMostInARow = 65'535; // on any device
    const uint32_t groups = (count + io::kPoseGroup - 1) / io::kPoseGroup;
    cmd.dispatch(std::min(groups, kMostInARow), (groups + kMostInARow - 1) / kMostInARow, 1);
}

} // namespace

PosedVertices::PosedVertices(const SceneResources& scene)
    : arena_(scene.shared.device), positions_(copyOf(arena_, scene.position_buffer)),
      surfaces_(copyOf(arena_, scene.surface_buffer)),
      extended_(copyOf(arena_, scene.extended_buffer)) {}

VertexBuffers PosedVertices::buffers() const {
    return {*positions_.handle, *surfaces_.handle, *extended_.handle};
}

uint64_t PosedVertices::bytes(const SceneResources& scene) {
    return scene.position_buffer.size_bytes + scene.surface_buffer.size_bytes +
           scene.extended_buffer.size_bytes;
}

void PosedVertices::recordRest(const vk::raii::CommandBuffer& cmd,
                               const SceneResources& scene) const {
    const auto copy = [&](const gpu::Buffer& from, const gpu::Buffer& to) {
        if (*to.handle) {
            cmd.copyBuffer(*from.handle, *to.handle, vk::BufferCopy{0, 0, from.size_bytes});
        }
    };
    copy(scene.position_buffer, positions_);
    copy(scene.surface_buffer, surfaces_);
    copy(scene.extended_buffer, extended_);
}

VertexBuffers vertexBuffers(const SceneResources& scene, const PosedVertices* posed) {
    return posed != nullptr
               ? posed->buffers()
               : VertexBuffers{*scene.position_buffer.handle, *scene.surface_buffer.handle,
                               *scene.extended_buffer.handle};
}

MeshPoser::MeshPoser(PosePipelines& pipelines,
                     gpu::MemoryArena& arena,
                     gpu::Uploader& uploader,
                     const scene::Scene& scene,
                     const PackedGeometry& geometry)
    : pipelines_(pipelines) {
    PoseTables tables = tablesOf(scene, geometry, jobs);
    for (const io::PoseJob& job : jobs) {
        vertex_count += job.vertex_count;
        flat |= job.flat_count > 0;
    }
    if (flat) {
        flat_normals_ = pipelines.flatNormals();
    }
    ranges = upload(arena, uploader, std::move(tables.ranges), "pose ranges");
    influences = upload(arena, uploader, std::move(tables.influences), "pose influences");
    deltas = upload(arena, uploader, std::move(tables.deltas), "pose deltas");
}

void MeshPoser::recordVertices(const vk::raii::CommandBuffer& cmd, vk::DescriptorSet set) const {
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines_.vertices());
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines_.layout(), 0, set, {});
    for (const io::PoseJob& job : jobs) {
        cmd.pushConstants<io::PoseJob>(pipelines_.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                       job);
        dispatchFor(cmd, job.vertex_count);
    }
}

void MeshPoser::recordFlatNormals(const vk::raii::CommandBuffer& cmd, vk::DescriptorSet set) const {
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, flat_normals_);
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines_.layout(), 0, set, {});
    for (const io::PoseJob& job : jobs) {
        if (job.flat_count > 0) {
            cmd.pushConstants<io::PoseJob>(pipelines_.layout(), vk::ShaderStageFlagBits::eCompute,
                                           0, job);
            dispatchFor(cmd, job.flat_count);
        }
    }
}

PoseSet::PoseSet(const gpu::Device& device, const MeshPoser& poser)
    : set_(device, poser.pipelines().setLayout(), PosePipelines::kBindings) {}

void PoseSet::write(const SceneResources& scene,
                    const MeshPoser& poser,
                    const PosedVertices& posed,
                    const vk::DescriptorBufferInfo& joints,
                    const vk::DescriptorBufferInfo& weights) const {
    const auto all = [](vk::Buffer buffer) {
        return vk::DescriptorBufferInfo{buffer, 0, VK_WHOLE_SIZE};
    };
    const VertexBuffers rest = vertexBuffers(scene, nullptr);
    const VertexBuffers moved = posed.buffers();
    // Without extended vertices no job has tangents.
    const std::array<vk::DescriptorBufferInfo, PosePipelines::kBindings> buffers = {
        all(rest.positions),
        all(rest.surfaces),
        all(rest.extended ? rest.extended : rest.surfaces),
        all(*scene.index_buffer.handle),
        all(*poser.ranges.handle),
        all(*poser.influences.handle),
        all(*poser.deltas.handle),
        joints,
        weights,
        all(moved.positions),
        all(moved.surfaces),
        all(moved.extended ? moved.extended : moved.surfaces)};
    set_.write(buffers);
}

} // namespace froxel::render
