// Compiled pipelines on disk. A file is used only on the device and driver, and by the build, that
// wrote it; anything else in its place is ignored and written anew.
#pragma once

#include "core/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace froxel::gpu {

// Who may use a file.
struct PipelineCacheKey {
    uint32_t vendor = 0;
    uint32_t device = 0;
    uint32_t driver_version = 0;
    uint32_t padding = 0;
    uint64_t build = 0;             // hash of the build's shaders
    std::array<uint8_t, 16> uuid{}; // VkPhysicalDeviceProperties::pipelineCacheUUID
    bool operator==(const PipelineCacheKey&) const = default;
};

struct PipelineCacheContent {
    std::vector<std::byte> bytes; // what vkCreatePipelineCache takes; empty: no use
    std::string refused;          // why a file that is there is of no use; empty: it is absent
};

// FNV-1a, 64 bits; continue a hash by passing it as `seed`.
[[nodiscard]] uint64_t hashBytes(std::span<const std::byte> bytes,
                                 uint64_t seed = 0xcbf29ce484222325U);

// $XDG_CACHE_HOME/froxel or ~/.cache/froxel; empty where neither variable is an absolute path.
[[nodiscard]] std::filesystem::path defaultPipelineCacheFolder();

// One file a device: another build or driver replaces what its forerunner left.
[[nodiscard]] std::filesystem::path pipelineCacheFile(const std::filesystem::path& folder,
                                                      const PipelineCacheKey& key);

[[nodiscard]] PipelineCacheContent readPipelineCache(const std::filesystem::path& file,
                                                     const PipelineCacheKey& key);

// Replaces the file at once, for readers and other writers alike; makes the folder (for its owner
// only) where it is missing. Errors: kIo.
[[nodiscard]] Result<void> writePipelineCache(const std::filesystem::path& file,
                                              const PipelineCacheKey& key,
                                              std::span<const std::byte> bytes);

} // namespace froxel::gpu
