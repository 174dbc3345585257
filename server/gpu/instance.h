// The Vulkan instance, and what its validation layer had to say.
#pragma once

#include "gpu/vulkan.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace froxel::gpu {

// Collects every warning and error of the validation layer. Any thread.
class ValidationLog {
  public:
    void add(std::string message);
    [[nodiscard]] std::vector<std::string> messages() const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

class Instance {
  public:
    // Throws StartupError(kDevice) when Vulkan 1.3, or the layer asked for, is missing.
    explicit Instance(bool validation);

    [[nodiscard]] const vk::raii::Instance& handle() const { return instance_; }
    [[nodiscard]] const ValidationLog& validationLog() const { return *log_; }
    [[nodiscard]] bool validating() const { return validating_; }

  private:
    std::unique_ptr<ValidationLog> log_;
    vk::raii::Context context_;
    vk::raii::Instance instance_{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
    bool validating_ = false;
};

} // namespace froxel::gpu
