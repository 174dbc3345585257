// What the steps of a frame share on the device, and the barriers that follow from how they use it.
#pragma once

#include "render/pipelines/barrier.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace froxel::render {

enum class Resource : uint8_t {
    kPosed,             // vertices that bend
    kLists,             // light lists made on the device
    kAtlas,             // of shadow maps
    kDepth,             // of solid surfaces
    kIds,               // of visible triangles
    kWords,             // depth and id, 64 bits a pixel
    kGbuffer,           // both targets
    kRadiance,          // the linear picture
    kTransmissiveDepth, // of the layers of surfaces that transmit light
    kFroxels,           // the fog's volume
    kDisplay,           // packed pixels that a filter reads
    kDisplay2,          // likewise, where another filter follows
    kPixels,            // packed pixels
    kCount
};

struct Use {
    Resource what;
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
    bool operator==(const Use&) const = default;
};

// Uses that several steps have.
namespace use {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

inline constexpr vk::AccessFlags2 kLoadStore =
    Access::eShaderStorageRead | Access::eShaderStorageWrite;

[[nodiscard]] constexpr Use sampled(Resource what, vk::PipelineStageFlags2 in) {
    return {what, in, Access::eShaderSampledRead};
}
// By a compute pass over the picture.
[[nodiscard]] constexpr Use sampled(Resource what) {
    return sampled(what, Stage::eComputeShader);
}
[[nodiscard]] constexpr Use stored(Resource what) {
    return {what, Stage::eComputeShader, kLoadStore};
}
[[nodiscard]] constexpr Use loaded(Resource what) {
    return {what, Stage::eComputeShader, Access::eShaderStorageRead};
}
// As a colour attachment, over what is there or not.
[[nodiscard]] constexpr Use drawn(Resource what) {
    return {what, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentRead | Access::eColorAttachmentWrite};
}
// Depth, tested and written.
[[nodiscard]] constexpr Use depthTested() {
    return {Resource::kDepth, kDepthStages,
            Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite};
}
// Vertices that bend, by the rasteriser.
[[nodiscard]] constexpr Use vertices() {
    return {Resource::kPosed, Stage::eVertexAttributeInput, Access::eVertexAttributeRead};
}
[[nodiscard]] constexpr Use copied(Resource what) {
    return {what, Stage::eCopy, Access::eTransferRead};
}

} // namespace use

[[nodiscard]] bool writes(const Use& use);

// What waits for what.
struct Dependency {
    vk::PipelineStageFlags2 from;
    vk::AccessFlags2 written;
    vk::PipelineStageFlags2 to;
    vk::AccessFlags2 used;
    bool operator==(const Dependency&) const = default;
};

// The last writers and readers of each resource in a frame. A frame begins with a barrier against
// everything before it (FramePieces), so nothing of earlier frames is in it.
class UseTracker {
  public:
    // What must lie between all steps so far and one with these uses; none: nothing.
    [[nodiscard]] std::optional<Dependency> before(std::span<const Use> uses);

  private:
    struct State {
        vk::PipelineStageFlags2 write_stages;
        vk::AccessFlags2 write_access;
        vk::PipelineStageFlags2 read_stages; // since the last write
        std::vector<Use> seen;               // reads that the last write is visible to
    };
    std::array<State, static_cast<size_t>(Resource::kCount)> states_;
};

} // namespace froxel::render
