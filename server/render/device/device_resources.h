// What all scenes on a device share. Nothing here knows a scene: another one compiles nothing that
// is there. Render thread, but for what says otherwise.
#pragma once

#include "cluster/light_assigner.h"
#include "gpu/command_context.h"
#include "gpu/memory.h"
#include "render/device/memory_budget.h"
#include "render/device/pose_pipelines.h"
#include "render/device/scene_options.h"
#include "render/device/unit_costs.h"
#include "render/device/visibility_pipelines.h"
#include "render/lists/assign_pipelines.h"
#include "render/pipelines/pipelines.h"
#include "render/pipelines/typed_store.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace froxel::render {

class DeviceResources {
  public:
    DeviceResources(gpu::Device& device,
                    const MemoryLimits& limits,
                    const SceneOptions& scene_options);
    ~DeviceResources() { variants.stop(); } // which makes what refers to the rest
    DeviceResources(const DeviceResources&) = delete;
    DeviceResources& operator=(const DeviceResources&) = delete;

    gpu::Device& device;
    const SceneOptions scene_options;
    gpu::Timeline timeline;
    std::optional<gpu::Timeline> copies; // beside it; none: the device has no queue for them
    MemoryBudget memory;
    cluster::LightAssigner light_assigner;
    VariantMaker variants;
    Pipelines pipelines;
    // Of this device; see device_speed.h.
    UnitCosts unit_costs;

    // Made at the first call. Null: the device cannot assign lights as the host does.
    [[nodiscard]] const AssignPipelines* assignment();
    // What views that ask for it share, such as pipelines: made from this at the first call. Throws
    // vk::SystemError.
    template <class T>
    [[nodiscard]] T& stored() {
        return stored_.findOrMake<T>(*this);
    }
    // Made at the first call, likewise.
    // The highlights of rectangular lights: area_light_table::table().
    [[nodiscard]] const gpu::Buffer& ltcTable();
    // Where a shader reads so many textures at once; 0: where it reads one material's.
    [[nodiscard]] VisibilityPipelines& visibilityPipelines(uint32_t texture_count);
    // Any thread. Throws StartupError where the device binds too few buffers, too.
    [[nodiscard]] PosePipelines& posePipelines();
    // The variants kept, of whatever draws surfaces and of whoever called listVariants().
    [[nodiscard]] std::vector<Pipelines::Made> variantsMade() const;
    // `list`, which adds variants, is called as long as this lives.
    void listVariants(std::function<void(std::vector<Pipelines::Made>&)> list) {
        variant_lists_.push_back(std::move(list));
    }

  private:
    std::map<uint32_t, VisibilityPipelines> visibility_pipelines_; // by texture_count
    std::mutex pose_mutex_;
    std::unique_ptr<PosePipelines> pose_pipelines_;
    bool assignment_tried_ = false;
    std::unique_ptr<AssignPipelines> assignment_;
    std::vector<std::function<void(std::vector<Pipelines::Made>&)>> variant_lists_;
    std::unique_ptr<gpu::MemoryArena> ltc_arena_;
    gpu::Buffer ltc_table_;
    TypedStore stored_;
};

} // namespace froxel::render
