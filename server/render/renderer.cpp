#include "render/renderer.h"

#include "core/assert.h"
#include "render/blended_recorder.h"
#include "render/fog_plan.h"
#include "render/frame_builder.h"
#include "render/frame_recorder.h"
#include "render/frame_slot.h"
#include "render/memory_report.h"
#include "render/radiance_readback.h"
#include "render/refusals.h"
#include "render/scene_resources.h"
#include "render/visibility_readback.h"

#include <array>
#include <cstring>
#include <deque>

namespace froxel::render {

namespace {

using Clock = std::chrono::steady_clock;

double microsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

} // namespace

Renderer::Renderer(gpu::Device& device, const scene::Scene& scene)
    : resources_(std::make_unique<SceneResources>(device, scene)) {}

Renderer::~Renderer() = default;

struct ViewRenderer::Impl {
    Impl(SceneResources& scene_in, const ListLimits& limits)
        : scene(scene_in), builder(scene_in, limits) {
        for (uint32_t i = 0; i < kReadbackSlots; ++i) {
            slots.push_back(
                std::make_unique<FrameSlot>(scene.device, scene.timeline, scene.pipelines));
        }
    }
    ~Impl() {
        for (const FrameSlot* slot : pending) {
            // A lost device has nothing left to wait for.
            (void)scene.timeline.wait(slot->done_value);
        }
    }

    [[nodiscard]] FrameSlot* freeSlot() const {
        for (const auto& slot : slots) {
            if (slot->free()) {
                return slot.get();
            }
        }
        return nullptr;
    }
    void prepareTargets(FrameSlot& slot,
                        const FramePlan& plan,
                        const view::Size& drawn,
                        const view::Size& shown);
    void prepareBlend(FrameSlot& slot, const FramePlan& plan);
    // Kept while settings ask for them, also with no light in view.
    void prepareShadows(FrameSlot& slot, const FramePlan& plan, const view::Shadows& settings);
    void writeVisibilitySet(FrameSlot& slot, const UploadOffsets& offsets) const;
    // Errors: kCapacity. Throws vk::SystemError.
    [[nodiscard]] Result<void> submit(FrameSlot& slot, const FrameInputs& inputs);
    // Draws a completed frame again until its lists are whole. Throws vk::SystemError.
    [[nodiscard]] Result<void> redraw(FrameSlot& slot);

    SceneResources& scene;
    FrameBuilder builder;
    std::vector<std::unique_ptr<FrameSlot>> slots;
    std::deque<FrameSlot*> pending; // submitted, oldest first
    std::shared_ptr<ViewTargets> targets;
    std::shared_ptr<BloomTargets> bloom;    // null: the last frame has none
    std::shared_ptr<BlendTargets> blend;    // likewise
    std::shared_ptr<ShadowTargets> shadows; // likewise
    std::shared_ptr<FogVolume> fog;         // likewise
    FrameDetailsKeeper details;
};

void ViewRenderer::Impl::prepareTargets(FrameSlot& slot,
                                        const FramePlan& plan,
                                        const view::Size& drawn,
                                        const view::Size& shown) {
    const TargetNeeds wanted{.gbuffer = plan.gbuffer,
                             .gbuffer_flags = plan.gbuffer_output_flags,
                             .radiance = plan.radiance,
                             .visibility = plan.visibility,
                             .compute_raster = plan.compute_raster,
                             .sampled_radiance = plan.bloom != view::BloomKind::kNone,
                             .display = plan.fxaa,
                             .device_pixels = !scene.device.traits().is_cpu};
    const bool same_size = targets && targets->size == drawn && targets->shown == shown;
    if (!same_size || !targets->needs.covers(wanted)) {
        TargetNeeds grown = wanted;
        if (same_size) {
            if (!wanted.gbuffer && targets->needs.gbuffer) {
                grown.gbuffer = true;
                grown.gbuffer_flags = targets->needs.gbuffer_flags;
            }
            grown.radiance |= targets->needs.radiance;
            grown.visibility |= targets->needs.visibility;
            grown.compute_raster |= targets->needs.compute_raster;
        }
        // Frames in flight keep the old targets alive through their slots.
        targets.reset();
        bloom.reset();
        blend.reset();
        targets = std::make_shared<ViewTargets>(scene.device, drawn, shown, grown);
    }
    targets->rastered_in_compute = plan.compute_raster;
    slot.targets = targets;
    const vk::DeviceSize bytes = vk::DeviceSize{4} * shown.width_px * shown.height_px;
    if (!slot.readback || slot.readback->buffer.size_bytes != bytes) {
        slot.readback.reset();
        slot.readback = std::make_shared<Readback>(scene.device, bytes);
    }
}

void ViewRenderer::Impl::prepareBlend(FrameSlot& slot, const FramePlan& plan) {
    slot.blend.reset(); // its last frame has finished
    slot.blend = blend =
        blendTargetsFor(plan, scene.device, scene.pipelines, targets, std::move(blend));
    slot.counts_overflow = countsOverflow(plan, builder.draws());
    if (slot.counts_overflow && !slot.overflow) {
        slot.overflow = std::make_unique<gpu::SampleCounter>(scene.device);
    }
}

void ViewRenderer::Impl::prepareShadows(FrameSlot& slot,
                                        const FramePlan& plan,
                                        const view::Shadows& settings) {
    slot.shadows.reset(); // its last frame has finished
    shadows = shadowTargetsFor(scene.device, settings, builder.localLightCount(), plan.shadows,
                               std::move(shadows));
    if (plan.shadows) {
        slot.shadows = shadows;
        if (!slot.shadow_slot) {
            slot.shadow_slot = std::make_unique<ShadowSlot>(scene.device, scene.pipelines);
        }
    }
}

void ViewRenderer::Impl::writeVisibilitySet(FrameSlot& slot, const UploadOffsets& offsets) const {
    if (!slot.visibility) {
        slot.visibility = std::make_unique<VisibilityFrame>(scene.device, scene.visibility());
    }
    const auto& t = *slot.targets;
    slot.visibility->write(
        {.resources = scene,
         .scene = scene.visibility(),
         .instances = {slot.upload.buffer(), offsets.instances,
                       scene.instances.size() * sizeof(io::InstanceView)},
         .order = {slot.upload.buffer(), offsets.meshlet_order,
                   scene.visibility().placed.size() * sizeof(uint32_t)},
         .ids = *t.ids.view,
         .gbuffer = t.needs.gbuffer ? *t.gbuffer.view : *t.ids.view,
         .raster = t.rastered_in_compute ? &scene.visibility().computeRaster() : nullptr,
         .words = *t.words.handle,
         .depth = *t.compute_depth.view});
}

Result<void> ViewRenderer::Impl::submit(FrameSlot& slot, const FrameInputs& asked) {
    const auto start = Clock::now();
    FrameInputs inputs = asked;
    inputs.settings.size = drawnSize(asked.settings);
    const FramePlan plan = builder.build(inputs);
    if (auto affordable = builder.affordable(inputs); !affordable) {
        return affordable;
    }
    std::optional<BloomPlan> bloom_plan;
    if (plan.bloom != view::BloomKind::kNone) {
        const auto& settings = inputs.settings;
        bloom_plan = planBloom(settings.bloom, settings.size, settings.exposure);
        if (auto affordable =
                checkBloomBudget(*bloom_plan, settings.size, scene.device.traits().is_cpu);
            !affordable) {
            return affordable;
        }
    }
    const BloomPlan* bloom_steps = bloom_plan ? &*bloom_plan : nullptr;
    prepareTargets(slot, plan, inputs.settings.size, asked.settings.size);
    slot.bloom.reset(); // its last frame has finished
    slot.bloom = bloom =
        bloom_steps != nullptr
            ? bloomTargetsFor(scene.device, scene.bloom(), *bloom_steps, targets, std::move(bloom))
            : nullptr;
    prepareBlend(slot, plan);
    slot.fog.reset(); // its last frame has finished
    slot.fog = fog = plan.fog_volume ? fogVolumeFor(scene.device, scene.fog(),
                                                    froxelCount(builder.fog()), std::move(fog))
                                     : nullptr;
    prepareShadows(slot, plan, inputs.settings.shadows);
    const UploadOffsets offsets = builder.upload(slot);
    if (plan.shadows) {
        slot.shadow_slot->write(slot.upload.buffer(), offsets.shadow_uniforms);
    }
    writeScreenSet(scene.device, slot, plan.fxaa ? targets->display : pixelsOf(slot));
    if (plan.fxaa) {
        if (!slot.fxaa) {
            slot.fxaa = std::make_unique<FxaaSlot>(scene.device, scene.fxaa());
        }
        slot.fxaa->write(targets->display, pixelsOf(slot));
    }
    if (plan.visibility) {
        writeVisibilitySet(slot, offsets);
    }
    if (plan.count_pairs && !slot.pairs) {
        slot.pairs = std::make_unique<PairCounter>(scene.device, scene.pipelines);
    }
    const bool debug = plan.debug != view::DebugView::kNone;
    if (debug && !slot.debug) {
        slot.debug = std::make_unique<DebugPass>(scene.device, scene.pipelines);
    }
    if (plan.count_samples && !slot.samples) {
        slot.samples = std::make_unique<gpu::SampleCounter>(scene.device);
    }
    recordFrame({.scene = scene,
                 .slot = slot,
                 .plan = plan,
                 .draws = builder.draws(),
                 .offsets = offsets,
                 .background = builder.background(),
                 .visibility = plan.visibility ? &scene.visibility() : nullptr,
                 .debug = debug ? &builder.debugFrame() : nullptr,
                 .bloom = bloom_steps,
                 .fog = plan.fog ? &builder.fog() : nullptr,
                 .shadows = plan.shadows ? &builder.shadows() : nullptr});
    slot.stats = {};
    slot.stats.triangle_count = builder.draws().triangle_count;
    if (plan.visibility) { // the host does not know what the device culls
        slot.stats.triangle_count += scene.visibility().triangle_count;
    }
    slot.stats.draw_count = static_cast<uint32_t>(builder.draws().commands.size());
    slot.stats.shadows = builder.shadows().stats();
    slot.stats.lists = builder.listStats();
    slot.stats.peel.layer_count = peelLayers(plan, builder.draws());
    slot.stats.details = details.update(inputs.settings, builder.plannedFacts(), plan, scene.needs,
                                        *scene.device.memoryLedger(),
                                        debug ? &builder.debugFrame().legend : nullptr);
    slot.stats.grid = builder.gridStats();
    slot.counts_pairs = plan.count_pairs;
    slot.counts_samples = plan.count_samples;
    slot.stats.pairs.counted = inputs.settings.count_pairs; // without lights: as none
    slot.stats.host_us = microsSince(start);
    slot.submitted = start;
    slot.done_value = scene.timeline.submit(slot.cmd);
    slot.in_flight = true;
    slot.stale = false;
    return {};
}

// The targets are the view's: frames submitted since must be drawn again after this one, so that
// readLinear() still finds the last.
Result<void> ViewRenderer::Impl::redraw(FrameSlot& slot) {
    uint32_t count = 0;
    const auto submitted = slot.submitted;
    while (slot.stale || (slot.device_lists && !builder.acceptLists(slot.assignment->totals()))) {
        const FrameInputs inputs = slot.inputs;
        if (const auto submitted_again = submit(slot, inputs); !submitted_again) {
            return submitted_again.error();
        }
        if (const auto done = scene.timeline.wait(slot.done_value); !done) {
            return done.error();
        }
        ++count;
    }
    slot.submitted = submitted;
    if (slot.device_lists) {
        std::string why = std::move(slot.stats.lists.why);
        slot.stats.lists = listStats(slot.assignment->totals(), slot.assignment->lightCount(),
                                     slot.assignment->clusterCount());
        slot.stats.lists.why = std::move(why);
    }
    slot.stats.lists.redraw_count = count;
    for (FrameSlot* later : pending) {
        later->stale |= count > 0 && later != &slot;
    }
    return {};
}

ViewRenderer::ViewRenderer(Renderer& renderer, const ListLimits& limits)
    : impl_(std::make_unique<Impl>(renderer.resources(), limits)) {}

ViewRenderer::~ViewRenderer() = default;

bool ViewRenderer::canSubmit() const {
    return impl_->freeSlot() != nullptr;
}

uint32_t ViewRenderer::inFlight() const {
    return static_cast<uint32_t>(impl_->pending.size());
}

Result<void> ViewRenderer::submit(const FrameInputs& inputs) {
    FrameSlot* slot = impl_->freeSlot();
    FROXEL_ASSERT(slot != nullptr, "submit needs a free readback slot");
    if (auto able = canDraw(inputs, impl_->scene); !able) {
        return able;
    }
    try {
        slot->inputs = inputs;
        if (auto submitted = impl_->submit(*slot, inputs); !submitted) {
            return submitted;
        }
        impl_->pending.push_back(slot);
    } catch (const vk::OutOfDeviceMemoryError&) {
        impl_->blend.reset();
        impl_->bloom.reset(); // so that a smaller picture may fit
        impl_->fog.reset();
        impl_->shadows.reset();
        impl_->targets.reset();
        return noMemoryFor(inputs.settings);
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("the device failed: ") + error.what()};
    }
    return {};
}

Result<RenderedFrame> ViewRenderer::collect() {
    FROXEL_ASSERT(!impl_->pending.empty(), "collect needs a submitted frame");
    FrameSlot& slot = *impl_->pending.front();
    const auto done = impl_->scene.timeline.wait(slot.done_value);
    if (!done) {
        return done.error();
    }
    impl_->pending.pop_front();
    slot.in_flight = false;
    try {
        if (const auto whole = impl_->redraw(slot); !whole) {
            return whole.error();
        }
        slot.in_flight = false;
        slot.timestamps.read(slot.stats);
    } catch (const vk::OutOfDeviceMemoryError&) {
        slot.in_flight = false;
        return Error{ErrorCode::kCapacity,
                     "the device has no memory for this many light list entries"};
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("finishing a frame failed: ") + error.what()};
    }
    if (slot.counts_pairs) {
        slot.stats.pairs = slot.pairs->read();
    }
    if (slot.counts_overflow) {
        slot.stats.peel.overflow_count = slot.overflow->read();
    }
    if (slot.counts_samples) {
        const auto& drawn = slot.targets->size;
        impl_->scene.overdraw = static_cast<double>(slot.samples->read()) /
                                (static_cast<double>(drawn.width_px) * drawn.height_px);
    }
    slot.stats.frame_us = microsSince(slot.submitted);
    slot.readback->leased = true;
    const auto& size = slot.targets->shown;
    const PixelView pixels{.data = slot.readback->buffer.mapped,
                           .width_px = size.width_px,
                           .height_px = size.height_px,
                           .stride_bytes = size_t{4} * size.width_px};
    return RenderedFrame{
        .pixels = PixelLease(pixels, [readback = slot.readback] { readback->leased = false; }),
        .stats = slot.stats};
}

Result<LinearImage> ViewRenderer::readLinear() {
    FROXEL_ASSERT(impl_->targets && impl_->targets->needs.radiance,
                  "readLinear needs a frame with keep_radiance");
    try {
        return copyRadiance(impl_->scene, *impl_->targets);
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice,
                     std::string("reading the picture failed: ") + error.what()};
    }
}

Result<ShadowAtlas> ViewRenderer::readShadows() {
    FROXEL_ASSERT(impl_->shadows, "readShadows needs a frame with shadow maps");
    try {
        return copyShadows(impl_->scene, *impl_->shadows, impl_->builder.shadows());
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice,
                     std::string("reading the shadow maps failed: ") + error.what()};
    }
}

Result<Visibility> ViewRenderer::readVisibility(const scene::Scene& scene) {
    FROXEL_ASSERT(impl_->targets, "readVisibility needs a frame");
    try {
        return copyVisibility(impl_->scene, *impl_->targets, scene);
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice,
                     std::string("reading the visible triangles failed: ") + error.what()};
    }
}

} // namespace froxel::render
