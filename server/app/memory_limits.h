// How much memory a server lets its sessions take: by options, or by the device and the host.
#pragma once

#include "render/device/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace froxel::gpu {
class Device;
}

namespace froxel::app {

// Of a session, MiB. A CPU device's is host memory, which containers limit.
inline constexpr uint32_t kCpuSessionMemory_mib = 256;
inline constexpr uint32_t kGpuSessionMemory_mib = 2048;
// Of the host's memory, which is a CPU device's, too; the rest is for the process itself: the scene
// on the host, compiled pipelines, encoders' scratch.
inline constexpr double kHostMemoryShare = 0.75;
// Of what a GPU has for this process; drivers round up, and take some for themselves.
inline constexpr double kGpuMemoryShare = 0.8;

// Of the device's memory that is allowed, what scenes may take that a server goes over to.
inline constexpr double kSceneMemoryShare = 0.5;

// What this process may take of the host's memory: all of it, or less where a control group of it
// (version 2 or 1) says so. `root` is where /proc and /sys are; none where nothing can be read.
[[nodiscard]] std::optional<uint64_t> hostMemoryBytes(const std::filesystem::path& root = "/");

// What this process may still take of the host's memory: what is free there, less where a control
// group of it or its limit on address space (RLIMIT_AS) leaves less. None where nothing can be
// read.
[[nodiscard]] std::optional<uint64_t> freeMemoryBytes(const std::filesystem::path& root = "/");

// Of what is free, what reading a scene may take: the only one; one beside which others are read.
inline constexpr double kOnlyReadShare = 0.75;
inline constexpr double kSharedReadShare = 0.5;
// For each byte of the device that scenes may take: a scene that needs more to be read would be
// refused anyway.
inline constexpr uint64_t kReadBytesOfSceneByte = 3;
inline constexpr uint64_t kLeastReadBytes = uint64_t{256} << 20U;

// Of reading the scene that a command works with.
[[nodiscard]] uint64_t readMemoryBytes();

// Of reading scenes that a server goes over to, several at once. Any thread.
class ReadShares {
  public:
    // `free_bytes`: as freeMemoryBytes().
    explicit ReadShares(std::function<std::optional<uint64_t>()> free_bytes =
                            [] { return freeMemoryBytes(); })
        : free_bytes_(std::move(free_bytes)) {}

    // What one read may take, promised until it is let go: a part of what is free and not promised
    // to others. `scene_bytes`: that the server's scenes may take of the device.
    using Share = std::shared_ptr<const uint64_t>;
    [[nodiscard]] Share take(uint64_t scene_bytes);

  private:
    struct Promised {
        std::mutex mutex;
        uint64_t bytes = 0;
    };
    struct Promise {
        Promise(std::shared_ptr<Promised> all_promised, uint64_t promised_bytes)
            : all(std::move(all_promised)), bytes(promised_bytes) {}
        ~Promise() {
            const std::lock_guard lock(all->mutex);
            all->bytes -= bytes;
        }
        Promise(const Promise&) = delete;
        Promise& operator=(const Promise&) = delete;

        const std::shared_ptr<Promised> all;
        const uint64_t bytes;
    };
    const std::function<std::optional<uint64_t>()> free_bytes_;
    const std::shared_ptr<Promised> promised_ = std::make_shared<Promised>();
};

struct MemoryOptions {
    std::optional<uint32_t> device_mib;
    std::optional<uint32_t> session_mib;
    std::optional<uint32_t> scene_mib{};
};

// Of a session on either kind of device: as asked for, or the default.
[[nodiscard]] uint64_t sessionMemoryBytes(const MemoryOptions& options, bool device_is_cpu);
[[nodiscard]] render::MemoryLimits memoryLimits(const MemoryOptions& options,
                                                const gpu::Device& device);

// Of the scenes that a server goes over to, together.
[[nodiscard]] uint64_t sceneMemoryBytes(const MemoryOptions& options,
                                        const render::MemoryLimits& limits);

} // namespace froxel::app
