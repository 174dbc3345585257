// The passes that make a baseline JPEG of packed pixels, byte for byte TurboJPEG's: one from pixels
// to the codes of runs of units, one that places the runs in the scan, one that writes the file
// where the host reads it. No restart markers: differences of DC are known once the blocks are, and
// sums over runs place their codes.
#pragma once

#include "core/jpeg_format.h"
#include "gpu/memory.h"
#include "gpu/timestamps.h"
#include "interface/jpeg_io.h"
#include "render/device/device_resources.h"
#include "render/frame/jpeg_file.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/storage_set.h"
#include "render/pipelines/variant_cache.h"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>

namespace froxel::render {

// Luma's, and chroma's.
using JpegTablePair = std::array<io::JpegTables, 2>;
[[nodiscard]] JpegTablePair jpegTables(const JpegFormat& format);

// Why the device cannot make them; empty: it can.
[[nodiscard]] std::string jpegUnusable(const gpu::Device& device);

enum class JpegPass : uint8_t { kBlocks, kPlace, kStuff };

// Shared by every view.
class JpegPipelines {
  public:
    explicit JpegPipelines(DeviceResources& shared);

    // May throw VariantsMissing.
    [[nodiscard]] vk::Pipeline pipeline(JpegPass pass, const JpegFormat& format);
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    VariantCache<std::tuple<JpegPass, uint32_t, JpegTransform>> made_;
};

// What lies between the passes. One view's.
class JpegScratch final : public StepTargets {
  public:
    JpegScratch(const gpu::Device& device, const JpegSizes& sizes);

    [[nodiscard]] bool fits(const JpegSizes& sizes) const {
        return runs_.size_bytes == sizes.run_bytes && codes_.size_bytes == sizes.code_bytes;
    }
    [[nodiscard]] const gpu::Buffer& runs() const { return runs_; }
    [[nodiscard]] const gpu::Buffer& places() const { return places_; }
    [[nodiscard]] const gpu::Buffer& codes() const { return codes_; }

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer runs_;
    gpu::Buffer places_;
    gpu::Buffer codes_;
};

// One a frame slot.
class JpegSet {
  public:
    JpegSet(const gpu::Device& device, vk::DescriptorSetLayout layout);

    // `tables`: within `upload`, JpegTablePair. Not in flight.
    void write(const gpu::Buffer& pixels,
               vk::Buffer upload,
               vk::DeviceSize tables,
               const JpegScratch& scratch,
               const gpu::Buffer& file);
    [[nodiscard]] vk::DescriptorSet handle() const { return set_.handle(); }

  private:
    StorageSet set_;
};

// Reads pixels that were stored before; the file is there once the host may read. May throw
// VariantsMissing.
void recordJpeg(const vk::raii::CommandBuffer& cmd,
                gpu::Timestamps& timestamps,
                JpegPipelines& pipelines,
                const JpegFormat& format,
                const JpegSizes& sizes,
                const JpegSet& set);

} // namespace froxel::render
