// A lavapipe device with the validation layer on; any message of the layer fails the test.
#pragma once

#include "gpu/device.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <memory>

namespace froxel::test {

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override { openDevice({}); }
    void TearDown() override { closeDevice(); }

    // Replaces the device; renderers made on the old one must be gone.
    void openDevice(gpu::DeviceOptions options) {
        closeDevice();
        options.choice = gpu::DeviceChoice::kCpu;
        options.validation = true;
        device_ = std::make_unique<gpu::Device>(options);
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

} // namespace froxel::test
