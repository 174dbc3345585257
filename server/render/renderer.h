// Draws a scene. One Renderer a device and scene; one ViewRenderer a viewer. Everything here is
// used by one thread, the render thread; only PixelLease may end elsewhere.
#pragma once

#include "core/error.h"
#include "core/frame_stats.h"
#include "core/linear_image.h"
#include "core/pixel_view.h"
#include "core/visibility.h"
#include "gpu/device.h"
#include "render/frame_plan.h"
#include "render/list_limits.h"
#include "render/shadow_atlas.h"
#include "scene/scene.h"
#include "view/settings.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace froxel::render {

class SceneResources;

// How a deferred frame's solid surfaces reach the G-buffer. auto: through the visibility passes on
// a GPU that has what they need, where they are faster. Differs in rounding alone.
enum class GeometryPath : uint8_t { kAuto, kRaster, kVisibility, kComputeRaster };

// Where light lists are made. auto: on a GPU that rounds as the host does, else on the host. The
// lists are the same.
enum class AssignmentPlace : uint8_t { kAuto, kHost, kDevice };

struct FrameInputs {
    view::ViewSettings settings;
    double time_s = 0;          // the lights' clock; pauses and speed are already folded in
    bool keep_radiance = false; // for readLinear(): also keep the picture before the tone map
    // For tests and measurements.
    GenericParts generic = {};
    GeometryPath geometry = GeometryPath::kAuto;
    bool cull_meshlets = true; // in the visibility passes
    std::optional<bool> depth_prepass = {}; // none: where it pays
    AssignmentPlace assignment = AssignmentPlace::kAuto;
};

struct RenderedFrame {
    PixelLease pixels; // RGBA8 sRGB
    FrameStats stats;
};

// Geometry, textures and pipelines shared by all viewers of one scene.
class Renderer {
  public:
    Renderer(gpu::Device& device,
             const scene::Scene& scene); // throws StartupError, vk::SystemError
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] SceneResources& resources() { return *resources_; }

  private:
    std::unique_ptr<SceneResources> resources_;
};

// Targets, light lists and readback ring of one viewer. Frames complete in submission order.
class ViewRenderer {
  public:
    static constexpr uint32_t kReadbackSlots = 3;

    explicit ViewRenderer(Renderer& renderer, const ListLimits& limits = {});
    ~ViewRenderer();
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;

    // Whether a readback slot is free; submit() must not be called otherwise.
    [[nodiscard]] bool canSubmit() const;
    // Records and submits one frame; returns at once where the device runs on its own.
    // Errors: kCapacity when targets of this size do not fit or lights would take minutes
    // (light_budget.h); kDevice when the device is lost; kUnsupported when the settings ask for
    // what the device lacks.
    [[nodiscard]] Result<void> submit(const FrameInputs& inputs);
    // Waits for the oldest submitted frame; draws it again where its light lists did not fit the
    // device's memory for them. Errors: kCapacity, kDevice.
    [[nodiscard]] Result<RenderedFrame> collect();
    [[nodiscard]] uint32_t inFlight() const;
    // The linear picture of the frame last submitted, which had keep_radiance (not a fast path:
    // waits and copies).
    [[nodiscard]] Result<LinearImage> readLinear();
    // The shadow maps of the frame last submitted, which had some (not a fast path). Errors: kDevice.
    [[nodiscard]] Result<ShadowAtlas> readShadows();
    // Which triangles the frame last collected shows, which took the visibility passes; `scene` is
    // the renderer's (not a fast path: see visibility_readback.h). Errors: kDevice.
    [[nodiscard]] Result<Visibility> readVisibility(const scene::Scene& scene);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::render
