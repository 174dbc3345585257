// What the visibility passes know of a scene: every meshlet of its solid surfaces, or of those that
// transmit light, where it is placed, in the order of their draws, and all materials at once. Made
// when a frame first asks for it.
#pragma once

#include "gpu/memory.h"
#include "gpu/upload.h"
#include "interface/frame_io.h"
#include "interface/raster_io.h"
#include "interface/visibility_io.h"
#include "render/device/visibility_pipelines.h"
#include "render/scene/compute_raster.h"
#include "render/scene/mesh_poser.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace froxel::render {

class SceneResources;
class VisibilityScene;
struct DrawItem;

// Meshlets drawn in one call; of opaque materials one group holds all with the same faces.
struct VisibilityGroup {
    uint32_t material = 0;            // of masked ones
    MaterialFlags material_flags = 0; // what the raster pass looks at
    bool mirrored = false;
    io::MeshletGroup blocks{};
    uint32_t meshlet_count = 0;
};

// Which meshlets there are: those of the scene's triangles, or of its coarser levels, too.
enum class Detail : uint8_t { kExact, kLevels };

// Which surfaces: of several layers of a pixel only those that transmit light are kept.
enum class Surfaces : uint8_t { kSolid, kTransmissive };

// What culling hands on to the rasteriser; frames of all viewers follow each other on one queue.
struct CulledDraws {
    CulledDraws(const gpu::Device& device, const VisibilityScene& scene);

    gpu::MemoryArena arena;
    gpu::Buffer commands;
    gpu::Buffer ranks;
    gpu::Buffer counts;
};

class VisibilityScene {
  public:
    static constexpr size_t kMostOrdered = 65'536;
    // Throws vk::SystemError.
    VisibilityScene(SceneResources& scene,
                    std::span<const DrawItem> drawn,
                    Surfaces surfaces,
                    Detail detail,
                    gpu::Uploader& uploader);

    // Empty when visibility passes can draw them on the device, else why not.
    [[nodiscard]] static std::string unusable(const SceneResources& scene,
                                              std::span<const DrawItem> drawn,
                                              Surfaces surfaces,
                                              Detail detail);

    const Surfaces surfaces;

    std::vector<VisibilityGroup> groups;
    std::vector<uint32_t> materials_in_use;
    std::vector<io::PlacedMeshlet> placed; // the host's copy, for ordering them
    // Whether frames order them, near ones first: of more it would take too long, and those of
    // which several layers are kept spare each other nothing.
    [[nodiscard]] bool ordered() const {
        return surfaces == Surfaces::kSolid && placed.size() <= kMostOrdered;
    }
    [[nodiscard]] bool hasLevels() const { return *details.handle != vk::Buffer{}; }
    std::vector<uint32_t> item_instances;
    uint32_t block_count = 0;
    const MaterialFlags material_flags; // of any item
    uint32_t triangle_count = 0;        // of all meshlets

    gpu::MemoryArena arena;
    gpu::Buffer items;
    gpu::Buffer placed_meshlets;
    gpu::Buffer meshlets;
    gpu::Buffer details; // with levels; else none
    vk::Buffer words;    // MeshletList::words, where compute may raster
    gpu::Buffer group_buffer;
    gpu::Buffer materials;

    VisibilityPipelines& pipelines;

    // Made at the first call, as nobody asks where ids are rastered in compute. Throws
    // vk::SystemError.
    [[nodiscard]] const CulledDraws& culledDraws();

    // Why ids cannot be rastered in compute; empty: they can.
    std::string compute_unusable;
    // Of those rastered in compute together. For tests: fewer.
    uint32_t most_raster_triangles = io::kRasterMostTriangles;
    // Made at the first call; compute_unusable is empty. Throws vk::SystemError.
    [[nodiscard]] ComputeRaster& computeRaster();

    // Every texture of the scene; null where one material is bound at a time.
    [[nodiscard]] vk::DescriptorSet textureSet() const {
        return *texture_set_ ? *texture_set_ : vk::DescriptorSet{};
    }

  private:
    void writeTextures(const SceneResources& scene);

    const gpu::Device& device_;
    gpu::Buffer own_words_; // where the scene has none
    std::unique_ptr<CulledDraws> culled_draws_;
    std::unique_ptr<ComputeRaster> compute_raster_;
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet texture_set_{nullptr};
};

// One frame slot's view of it all: set 2.
class VisibilityFrame {
  public:
    VisibilityFrame(const gpu::Device& device, const VisibilityScene& scene);

    struct Bindings {
        const SceneResources& resources;
        const VisibilityScene& scene;
        const CulledDraws* draws = nullptr; // where the rasteriser draws; else none
        VertexBuffers vertices;
        vk::DescriptorBufferInfo instances; // io::InstanceView
        vk::DescriptorBufferInfo order;     // of the placed meshlets
        vk::ImageView ids;
        vk::ImageView gbuffer;
        // Where compute rasters; else none.
        const ComputeRaster* raster = nullptr;
        vk::Buffer words = {};
        vk::ImageView depth;
        vk::Buffer tiles = {}; // of layers, where several are kept; else none
    };
    // The slot is not in flight.
    void write(const Bindings& bindings);
    [[nodiscard]] vk::DescriptorSet set() const { return *set_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
};

// Likewise, of surfaces that transmit light, of the same slot.
class TransmissiveFrame : public VisibilityFrame {
  public:
    using VisibilityFrame::VisibilityFrame;
};

} // namespace froxel::render
