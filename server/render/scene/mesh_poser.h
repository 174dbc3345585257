// Vertices of meshes that bend, posed on the device once a frame, for all of its passes. What moves
// them is shared by all views, where they end is each view's own.
#pragma once

#include "gpu/memory.h"
#include "gpu/upload.h"
#include "interface/pose_io.h"
#include "render/device/pose_pipelines.h"
#include "render/pipelines/storage_set.h"
#include "render/scene/geometry_pack.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace froxel::render {

class SceneResources;

// What a frame's passes read as vertices.
struct VertexBuffers {
    vk::Buffer positions;
    vk::Buffer surfaces;
    vk::Buffer extended; // null: no primitive needs it
};

// One view's copy of the scene's vertices, in which those that bend stand as its frame has them.
// Its frames follow each other on the queue, with other views' between them.
class PosedVertices {
  public:
    // The scene has meshes that bend. Throws vk::SystemError.
    explicit PosedVertices(const SceneResources& scene);

    [[nodiscard]] VertexBuffers buffers() const;
    [[nodiscard]] static uint64_t bytes(const SceneResources& scene);

    // The scene's vertices at rest into it.
    void recordRest(const vk::raii::CommandBuffer& cmd, const SceneResources& scene) const;

    bool fresh = true; // these still have to be copied
    std::optional<uint64_t>
        pose; // ScenePose::number() that they hold once what is submitted has run

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer positions_;
    gpu::Buffer surfaces_;
    gpu::Buffer extended_;
};

// The view's own; the scene's where it has none.
[[nodiscard]] VertexBuffers vertexBuffers(const SceneResources& scene, const PosedVertices* posed);

// Shared by every view.
class MeshPoser {
  public:
    // The scene has deformed meshes, packed into `geometry`; pipelines and `arena` outlive it.
    // Throws vk::SystemError.
    MeshPoser(PosePipelines& pipelines,
              gpu::MemoryArena& arena,
              gpu::Uploader& uploader,
              const scene::Scene& scene,
              const PackedGeometry& geometry);

    // A frame's joints are those of each deformed mesh's skin, mesh by mesh; its weights are
    // motion::Pose's.
    std::vector<io::PoseJob> jobs;
    uint64_t vertex_count = 0; // of all jobs
    bool flat = false;         // some normals are those of triangles
    gpu::Buffer ranges;
    gpu::Buffer influences;
    gpu::Buffer deltas;

    [[nodiscard]] const PosePipelines& pipelines() const { return pipelines_; }
    // Both record into a frame; a barrier lies between them.
    void recordVertices(const vk::raii::CommandBuffer& cmd, vk::DescriptorSet set) const;
    void recordFlatNormals(const vk::raii::CommandBuffer& cmd, vk::DescriptorSet set) const;

  private:
    PosePipelines& pipelines_;
    vk::Pipeline flat_normals_; // null: none are
};

// One frame slot's.
class PoseSet {
  public:
    PoseSet(const gpu::Device& device, const MeshPoser& poser);

    // joints, weights: of the slot's upload. The slot is not in flight.
    void write(const SceneResources& scene,
               const MeshPoser& poser,
               const PosedVertices& posed,
               const vk::DescriptorBufferInfo& joints,
               const vk::DescriptorBufferInfo& weights) const;
    [[nodiscard]] vk::DescriptorSet set() const { return set_.handle(); }

  private:
    StorageSet set_;
};

} // namespace froxel::render
