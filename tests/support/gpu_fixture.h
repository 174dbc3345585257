// Devices for tests: lavapipe with the validation layer on, where any message of the layer fails
// the test; or, with FROXEL_TEST_DEVICE=gpu, a GPU without that layer.
#pragma once

#include "gpu/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <gmock/gmock.h>
#include <memory>
#include <string_view>
#include <type_traits>

namespace froxel::test {

inline bool onGpu() {
    const char* name = std::getenv("FROXEL_TEST_DEVICE");
    return name != nullptr && std::string_view(name) == "gpu";
}

inline std::unique_ptr<gpu::Device> openTestDevice(gpu::DeviceOptions options = {}) {
    options.choice = onGpu() ? gpu::DeviceChoice::kGpu : gpu::DeviceChoice::kCpu;
    options.validation = !onGpu();
    return std::make_unique<gpu::Device>(options);
}

// The driver's functions, of which a test may replace some. Their type has another name in later
// versions of Vulkan's headers.
inline auto& driverOf(const gpu::Device& device) {
    const auto* functions = device.handle().getDispatcher();
    using Functions = std::remove_const_t<std::remove_pointer_t<decltype(functions)>>;
    return const_cast<Functions&>(*functions);
}

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override { openDevice({}); }
    void TearDown() override { closeDevice(); }

    // Replaces the device; renderers made on the old one must be gone.
    void openDevice(const gpu::DeviceOptions& options) {
        closeDevice();
        device_ = openTestDevice(options);
    }
    void closeDevice() {
        if (device_) {
            EXPECT_THAT(device_->validationLog().messages(), ::testing::IsEmpty());
            device_.reset();
        }
    }
    [[nodiscard]] gpu::Device& device() { return *device_; }

  private:
    std::unique_ptr<gpu::Device> device_;
};

// One device for all tests of a suite: making it costs more than most of them.
class SharedGpuTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { device_ = openTestDevice(); }
    static void TearDownTestSuite() { device_.reset(); }
    void TearDown() override {
        EXPECT_THAT(device_->validationLog().messages(), ::testing::IsEmpty());
    }
    [[nodiscard]] static gpu::Device& device() { return *device_; }

    inline static std::unique_ptr<gpu::Device> device_;
};

} // namespace froxel::test
