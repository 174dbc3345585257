#include "render/device/device_resources.h"

#include "area_light_table/table.h"
#include "gpu/upload.h"
#include "render/lists/list_limits.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <thread>

namespace froxel::render {

DeviceResources::DeviceResources(gpu::Device& device_in,
                                 const MemoryLimits& limits,
                                 const SceneOptions& options)
    : device(device_in), scene_options(options), timeline(device_in),
      copies(device_in.copyQueue() != nullptr
                 ? std::optional<gpu::Timeline>(std::in_place, device_in, *device_in.copyQueue())
                 : std::nullopt),
      memory(limits),
      light_assigner(std::max(1U, std::thread::hardware_concurrency()), kHostListEntries),
      pipelines(device_in, timeline, variants),
      unit_costs(device_in.traits().is_cpu ? kCpuUnitCosts : kGpuUnitCosts) {}

VisibilityPipelines& DeviceResources::visibilityPipelines(uint32_t texture_count) {
    return visibility_pipelines_
        .try_emplace(texture_count, device, timeline, variants, pipelines, texture_count)
        .first->second;
}

PosePipelines& DeviceResources::posePipelines() {
    const std::lock_guard lock(pose_mutex_);
    if (!pose_pipelines_) {
        pose_pipelines_ = std::make_unique<PosePipelines>(device);
    }
    return *pose_pipelines_;
}

std::vector<Pipelines::Made> DeviceResources::variantsMade() const {
    auto all = pipelines.made();
    for (const auto& [texture_count, visibility] : visibility_pipelines_) {
        std::ranges::copy(visibility.made(), std::back_inserter(all));
    }
    for (const auto& list : variant_lists_) {
        list(all);
    }
    return all;
}

const gpu::Buffer& DeviceResources::ltcTable() {
    if (!ltc_arena_) {
        const auto bytes = std::as_bytes(area_light_table::table());
        auto made = std::make_unique<gpu::MemoryArena>(device);
        ltc_table_ = made->makeBuffer(bytes.size(),
                                      vk::BufferUsageFlagBits::eUniformTexelBuffer |
                                          vk::BufferUsageFlagBits::eTransferDst,
                                      gpu::MemoryUse::kDevice, "linearly transformed cosines");
        gpu::uploadNow(device, timeline, ltc_table_, bytes);
        ltc_arena_ = std::move(made);
    }
    return ltc_table_;
}

const AssignPipelines* DeviceResources::assignment() {
    if (!assignment_tried_) {
        assignment_tried_ = true;
        const std::string why = AssignPipelines::unusable(device, timeline);
        if (why.empty()) {
            assignment_ = std::make_unique<AssignPipelines>(device);
        } else {
            spdlog::info("lights are assigned on the host: {}", why);
        }
    }
    return assignment_.get();
}

} // namespace froxel::render
