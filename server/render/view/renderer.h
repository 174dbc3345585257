// Draws scenes. One RenderDevice a device; one Renderer a scene on it; one ViewRenderer a viewer.
// Everything here is used by one thread, the render thread; only PixelLease may end elsewhere.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "core/frame_stats.h"
#include "core/frame_work.h"
#include "core/linear_image.h"
#include "core/pixel_view.h"
#include "core/visibility.h"
#include "gpu/device.h"
#include "render/device/memory_budget.h"
#include "render/device/scene_options.h"
#include "render/frame/frame_inputs.h"
#include "render/lists/list_limits.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace froxel::render {

class DeviceResources;
class SceneResources;
class ViewSteps;
struct PassEstimate;

struct RenderedFrame {
    PixelLease pixels; // with the radiance where it was to be kept
    FrameStats stats;
};

// What became of the oldest piece.
struct PieceResult {
    bool again = false;                 // its frame must be begun again: lists turned out longer
    std::optional<RenderedFrame> frame; // it was the last one; neither: more follow, or given up
};

// What all scenes on a device share, such as pipelines.
class RenderDevice {
  public:
    // Throws vk::SystemError. The device outlives it, and it its Renderers.
    explicit RenderDevice(gpu::Device& device,
                          const MemoryLimits& limits = {},
                          const SceneOptions& scene_options = {});
    ~RenderDevice();
    RenderDevice(const RenderDevice&) = delete;
    RenderDevice& operator=(const RenderDevice&) = delete;

    // From now on variants are made on a thread of its own, and begin() does not wait for them. For
    // those who use begin() alone. niceness: as nice(2). Pipelines without variants, which a GPU
    // assigns lights with, are made before it returns.
    void makeVariantsInBackground(int niceness, unsigned thread_count);

    [[nodiscard]] DeviceResources& resources() { return *resources_; }
    [[nodiscard]] const SceneOptions& sceneOptions() const;

  private:
    std::unique_ptr<DeviceResources> resources_;
};

// Geometry and textures shared by all viewers of one scene, who end before it.
class Renderer {
  public:
    // Throws StartupError, vk::SystemError.
    Renderer(RenderDevice& on, const scene::Scene& scene);
    // The same for whoever has one scene alone.
    Renderer(gpu::Device& device,
             const scene::Scene& scene,
             const MemoryLimits& limits = {},
             const SceneOptions& scene_options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Of the device's memory.
    [[nodiscard]] uint64_t bytes() const;
    // Whether views may ask for a geometry error.
    [[nodiscard]] bool hasDetailLevels() const;
    [[nodiscard]] SceneResources& resources() { return *resources_; }

  private:
    friend class SceneUpload;
    explicit Renderer(std::unique_ptr<SceneResources> resources);

    std::unique_ptr<RenderDevice> own_; // null: the device is shared
    std::unique_ptr<SceneResources> resources_;
};

// What a scene will take of memory once it is on the device, about: geometry, textures, materials,
// and what the host keeps of its instances, meshlets and what moves them.
[[nodiscard]] uint64_t sceneBytes(const scene::Scene& scene, const SceneOptions& options);
// kCapacity, where the device's memory or the host's is not enough for a scene.
[[nodiscard]] Error noMemoryForScene(const std::string& whose);

// A scene on its way to a device that draws others meanwhile.
class SceneUpload {
  public:
    // Does all that needs no device's time; on any thread. Throws StartupError, vk::SystemError.
    SceneUpload(RenderDevice& on, std::shared_ptr<const scene::Scene> scene);
    ~SceneUpload();
    SceneUpload(const SceneUpload&) = delete;
    SceneUpload& operator=(const SceneUpload&) = delete;

    // Gives the device the next slice of it, unless it is still at what it was given
    // before. Null: not all is there yet; else nothing more is to be called. Errors: kDevice.
    [[nodiscard]] Result<std::unique_ptr<Renderer>> advance();
    // Of it that the device was given, 0 to 1.
    [[nodiscard]] double fraction() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Targets, light lists and readback ring of one viewer. Frames complete in submission order, each
// as pieces that run in order; between them the device may run those of other viewers.
class ViewRenderer {
  public:
    static constexpr uint32_t kReadbackSlots = 3;

    explicit ViewRenderer(Renderer& renderer,
                          const ListLimits& limits = {},
                          const WorkLimits& work = {});
    ~ViewRenderer();
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;

    // Whether a readback slot is free and no frame has pieces that wait; neither begin() nor
    // submit() may be called otherwise.
    [[nodiscard]] bool canSubmit() const;

    // Records one frame; nothing runs yet. Errors: kCapacity when targets of this size do not fit;
    // kTooLong when the frame would take longer than allowed; kDevice when the device is lost;
    // kUnsupported when the settings ask for what the device lacks.
    [[nodiscard]] Result<FrameWork> begin(const FrameInputs& inputs);
    // Frames begun from now on are cut finer, where that costs nothing: into pieces that by their
    // estimate take this share, of 1, of the limit.
    void setPieceShare(double share);
    // Likewise estimated, and held against the limits, by what earlier ones took.
    void setPace(const WorkPace& pace);
    // Gives the device the next piece of the frame begun last; returns at once where the device
    // runs on its own. Errors: kDevice.
    [[nodiscard]] Result<void> submitPiece();
    // Gives up the pieces of the frame begun last that wait, of which there is at least one; those
    // on the device are still to be collected, and with none there the frame is gone at once.
    void abandon();
    // Waits for the oldest piece on the device. Errors: kDevice.
    [[nodiscard]] Result<PieceResult> collectPiece();

    // The same for whoever has the device alone: a whole frame. Waits for the oldest one; draws it
    // again where its light lists did not fit the device's memory for them. Errors: begin()'s.
    [[nodiscard]] Result<void> submit(const FrameInputs& inputs);
    [[nodiscard]] Result<RenderedFrame> collect();
    [[nodiscard]] uint32_t inFlight() const;
    // Which triangles the frame last collected shows, which took the visibility passes; `scene` is
    // the renderer's (not a fast path: see visibility_readback.h). Errors: kDevice.
    [[nodiscard]] Result<Visibility> readVisibility(const scene::Scene& scene);

    // Those that its frames have had, for tests that look into one.
    [[nodiscard]] const ViewSteps& steps() const;
    // What the passes of the frame begun last take by their estimates, for tests.
    [[nodiscard]] const std::vector<PassEstimate>& prices() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::render
