// The device's light assignment by itself, with its lists brought back to the host.
#pragma once

#include "cluster/light_assigner.h"
#include "gpu/command_context.h"
#include "gpu/device.h"
#include "render/lists/gpu_light_lists.h"

#include <memory>

namespace froxel::test {

class DeviceAssigner {
  public:
    explicit DeviceAssigner(gpu::Device& device, const render::ListLimits& limits = {});
    ~DeviceAssigner();

    // Draws again with more room until the lists are whole, as a frame does; fails the test where
    // the device refuses.
    [[nodiscard]] cluster::LightLists assign(const cluster::ClusterGrid& grid,
                                             const light::FrameLights& lights);
    [[nodiscard]] uint32_t attempts() const; // of the last call
    [[nodiscard]] bool refused() const;
    [[nodiscard]] bool inLines() const; // of the last call: by one dispatch

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::test
