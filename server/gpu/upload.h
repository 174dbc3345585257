// Fills buffers and images of the device, a slice at a time: whoever draws is never kept waiting
// for all of a scene.
#pragma once

#include "gpu/command_context.h"
#include "gpu/memory.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace froxel::gpu {

// One thread at a time: one may note what is to be filled, and the timeline's then do it. The
// targets outlive it.
class Uploader {
  public:
    // staging_bytes: about what one slice copies.
    Uploader(const Device& device, vk::DeviceSize staging_bytes);
    ~Uploader(); // waits for the slice on the device
    Uploader(const Uploader&) = delete;
    Uploader& operator=(const Uploader&) = delete;

    // From offset 0. The data stays where it is until all is done.
    void upload(const Buffer& target, std::span<const std::byte> data);
    // The same of data that it keeps.
    template <class T>
    void upload(const Buffer& target, std::vector<T> data) {
        auto kept = std::make_shared<const std::vector<T>>(std::move(data));
        upload(target, std::as_bytes(std::span(*kept)));
        kept_.push_back(std::move(kept));
    }
    // The first levels are filled with tightly packed texels, which stay where they are; the others
    // are made of them by linear blits, in linear light for sRGB formats. Then the image is ready
    // for sampling.
    void uploadImage(const Image& target, std::span<const std::span<const std::byte>> levels);

    // Gives the device the next slice, unless it is still at the one before; whether all is done.
    // Throws vk::SystemError.
    [[nodiscard]] bool advance(Timeline& timeline);
    // Of what was noted that the device was given, 0 to 1.
    [[nodiscard]] double fraction() const;
    // All that was noted; waits. Throws vk::SystemError, StartupError.
    void finish(Timeline& timeline);

  private:
    struct Step;
    void note(Step step);

    struct Step {
        std::span<const std::byte> data; // into staging memory, at the offset that record() is told
        vk::DeviceSize cost = 0;         // as bytes that are copied
        std::function<void(const vk::raii::CommandBuffer&, vk::DeviceSize offset)> record;
    };

    MemoryArena arena_;
    Buffer staging_;
    std::vector<std::shared_ptr<const void>> kept_;
    std::deque<Step> steps_;
    vk::DeviceSize noted_cost_ = 0;
    vk::DeviceSize given_cost_ = 0;
    Timeline* timeline_ = nullptr;      // of `on_device_`
    std::optional<uint64_t> on_device_; // the slice's value
    vk::raii::CommandBuffer cmd_{nullptr};
};

// A buffer of the device's memory that is as large as the data and filled with them. A vector that
// is moved here is kept; another one stays where it is until the uploader is done. Throws
// vk::SystemError.
template <class Vector>
[[nodiscard]] Buffer makeFilled(MemoryArena& arena,
                                Uploader& uploader,
                                Vector&& data,
                                vk::BufferUsageFlags usage,
                                std::string_view name) {
    const auto bytes = std::as_bytes(std::span(data));
    Buffer buffer = arena.makeBuffer(bytes.size(), usage | vk::BufferUsageFlagBits::eTransferDst,
                                     MemoryUse::kDevice, name);
    if constexpr (std::is_lvalue_reference_v<Vector>) {
        uploader.upload(buffer, bytes);
    } else {
        uploader.upload(buffer, std::forward<Vector>(data));
    }
    return buffer;
}

// At once, for what is small. Throws vk::SystemError, StartupError.
void uploadNow(const Device& device,
               Timeline& timeline,
               const Buffer& target,
               std::span<const std::byte> data);

} // namespace froxel::gpu
