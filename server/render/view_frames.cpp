#include "render/view_frames.h"

#include "render/blended_recorder.h"
#include "render/frame_recorder.h"
#include "render/fresh_targets.h"
#include "render/memory_need.h"
#include "render/refusals.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Clock = std::chrono::steady_clock;

double microsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

// What a part of a frame takes that is to be cut this fine: each part has a timestamp, and the
// halves of one may be left at half of it.
Seconds partOf(Seconds frame, Seconds wanted) {
    constexpr double kMostParts = 512;
    static_assert(4 * kMostParts <= gpu::Timestamps::kMaxPasses / 2);
    return std::max(wanted, frame / kMostParts);
}

// None of its pieces was submitted yet.
void beginFlight(FrameSlot& slot) {
    slot.done_values.clear();
    slot.waited_count = 0;
    slot.given_up = false;
    slot.in_flight = true;
    slot.stale = false;
}

} // namespace

Result<void> ViewFrames::takeMemory(FrameSlot& slot,
                                    const FramePlan& plan,
                                    const FrameInputs& asked,
                                    const Slots& slots) {
    host_work_.gather(slot.upload, effects_.ofFrame());
    target_needs_ = targetNeeds(plan, scene_.shared.device, drawnSize(asked.settings),
                                asked.settings.size, targets_.get());
    FrameMemory frame = frameMemory(host_work_, plan, asked, target_needs_, effects_.ofFrame());
    letGo(slots, slot, frame);
    if (auto taken = take(memory_, frame, scene_.shared.device, pictureWords(asked.settings));
        !taken) {
        host_work_.letGo();
        return taken;
    }
    // What does not fit goes before anything else is made; frames in flight keep theirs.
    if (targets_ && !targets_->fits(frame.drawn, frame.shown, target_needs_)) {
        targets_.reset();
        blend_.reset();
    }
    effects_.freeUnfit(targets_.get());
    return {};
}

bool ViewFrames::reusesSurfaces(const FramePlan& plan, const FrameInputs& asked) const {
    const settings::Size drawn = drawnSize(asked.settings);
    return asked.keep_surfaces && targets_ && !targets_->fresh && leavesSurfaces(plan) &&
           targets_->surfaces == host_work_.surfaces(plan) &&
           targets_->fits(
               drawn, asked.settings.size,
               targetNeeds(plan, scene_.shared.device, drawn, asked.settings.size, targets_.get()));
}

bool ViewFrames::reusesPose(const FrameInputs& asked) const {
    return asked.keep_surfaces && posed_ && !posed_->fresh &&
           posed_->pose == host_work_.pose().number();
}

void ViewFrames::noteDrawn(const FramePlan& plan, const SurfacesDrawn& surfaces) {
    targets_->surfaces.reset();
    if (leavesSurfaces(plan)) {
        targets_->surfaces = surfaces;
    }
    if (plan.pose) {
        posed_->pose = host_work_.pose().number();
    }
}

void ViewFrames::prepareTargets(FrameSlot& slot,
                                const FramePlan& plan,
                                const settings::Size& drawn,
                                const settings::Size& shown) {
    if (!targets_) {
        targets_ = std::make_shared<ViewTargets>(scene_.shared.device, drawn, shown, target_needs_);
    }
    targets_->rastered_in_compute = plan.compute_raster;
    slot.targets = targets_;
    slot.makeReadback(scene_.shared.device, readbackBytes(drawn, shown, slot.inputs.keep_radiance));
}

void ViewFrames::prepareBlend(FrameSlot& slot, const FramePlan& plan) {
    slot.blend.reset(); // its last frame has finished
    slot.blend = blend_ = blendTargetsFor(plan, scene_.shared.device, scene_.shared.pipelines,
                                          targets_, std::move(blend_));
    slot.counts_overflow = countsOverflow(plan, host_work_.draws());
    if (slot.counts_overflow && !slot.overflow) {
        slot.overflow = std::make_unique<gpu::SampleCounter>(scene_.shared.device);
    }
}

void ViewFrames::preparePose(FrameSlot& slot, const UploadOffsets& offsets) {
    const MeshPoser& poser = *scene_.poser();
    if (!posed_) {
        posed_ = std::make_shared<PosedVertices>(scene_);
    }
    slot.posed = posed_;
    if (!slot.pose) {
        slot.pose = std::make_unique<PoseSet>(scene_.shared.device, poser);
    }
    const auto part = [&](vk::DeviceSize offset, size_t bytes) {
        // Where there are none, of what nothing reads.
        return vk::DescriptorBufferInfo{slot.upload.buffer(), offset, std::max<size_t>(bytes, 16)};
    };
    slot.pose->write(scene_, poser, *posed_,
                     part(offsets.joints, host_work_.pose().joints().size_bytes()),
                     part(offsets.weights, host_work_.pose().weights().size_bytes()));
}

void ViewFrames::writeVisibilitySet(FrameSlot& slot, const UploadOffsets& offsets) const {
    if (!slot.visibility) {
        slot.visibility = std::make_unique<VisibilityFrame>(scene_.shared.device,
                                                            slot.material_set->visibility());
    }
    const auto& t = *slot.targets;
    slot.visibility->write(
        {.resources = scene_,
         .scene = slot.material_set->visibility(),
         .vertices = vertexBuffers(scene_, slot.posed.get()),
         .instances = {slot.upload.buffer(), offsets.instances,
                       scene_.instances.size() * sizeof(io::InstanceView)},
         .order = {slot.upload.buffer(), offsets.meshlet_order,
                   slot.material_set->visibility().placed.size() * sizeof(uint32_t)},
         .ids = *t.ids.view,
         .gbuffer = t.needs.gbuffer ? *t.gbuffer.view : *t.ids.view,
         .raster =
             t.rastered_in_compute ? &slot.material_set->visibility().computeRaster() : nullptr,
         .words = *t.words.handle,
         .depth = *t.compute_depth.view});
}

void ViewFrames::prepareParts(FrameSlot& slot,
                              const FramePlan& plan,
                              const UploadOffsets& offsets) {
    writeScreenSet(scene_.shared.device, slot,
                   plan.hasEffect(EffectPlace::kPixels) ? targets_->display : pixelsOf(slot));
    if (plan.pose) {
        preparePose(slot, offsets);
    }
    if (plan.visibility) {
        writeVisibilitySet(slot, offsets);
    }
    if (plan.count_pairs && !slot.pairs) {
        slot.pairs = std::make_unique<PairCounter>(scene_.shared.device, scene_.shared.pairs());
    }
    if (plan.count_samples && !slot.samples) {
        slot.samples = std::make_unique<gpu::SampleCounter>(scene_.shared.device);
    }
}

void ViewFrames::noteBuilt(FrameSlot& slot, const FramePlan& plan, const FrameInputs& inputs) {
    slot.stats = {};
    slot.stats.surfaces_reused = plan.reused;
    slot.stats.triangle_count = host_work_.draws().triangle_count;
    if (plan.visibility) { // the host does not know what the device culls
        slot.stats.triangle_count += slot.material_set->visibility().triangle_count;
    }
    slot.stats.draw_count = static_cast<uint32_t>(host_work_.draws().commands.size());
    slot.effects.assign(effects_.ofFrame().begin(), effects_.ofFrame().end());
    for (const auto& [place, effect] : slot.effects) {
        effect->addStats(slot.stats);
    }
    slot.stats.lists = host_work_.listStats();
    slot.stats.peel.layer_count = peelLayers(plan, host_work_.draws());
    FramePlan described = plan;
    // Come and go: of this frame's figures, not of what describes many.
    described.reused = described.pose_reused = false;
    slot.stats.details = details_.update(
        inputs.settings, host_work_.plannedFacts(), described, scene_.needs,
        *scene_.shared.device.memoryLedger(),
        plan.debug != settings::DebugView::kNone ? &host_work_.debugFrame().legend : nullptr);
    slot.stats.grid = host_work_.gridStats();
    slot.counts_pairs = plan.count_pairs;
    slot.counts_samples = plan.count_samples;
    slot.stats.pairs.counted = inputs.settings.count_pairs; // without lights: as none
}

Result<ViewFrames::Made>
ViewFrames::record(FrameSlot& slot, const FrameInputs& inputs, const Slots& slots) {
    VariantMaker& variants = scene_.shared.variants;
    if (variants.busyFor(this)) {
        return Made::kNothing;
    }
    variants.setAsker(this);
    variants.beginRecording();
    try {
        const uint64_t since = scene_.shared.timeline.next();
        const auto recorded = recordNow(slot, inputs, slots);
        slot.uses = variants.endRecording(since);
        if (!recorded || !*recorded) {
            slot.uses.giveUp();
            slot.uses.end();
        }
        if (!recorded) {
            host_work_.forgetLists();
            return recorded.error();
        }
        return *recorded ? Made::kFrame : Made::kHalf;
    } catch (const VariantsMissing&) {
        variants.endRecording(0).giveUp();
        markFresh(slot); // nothing of what was recorded runs
        return Made::kNothing;
    } catch (...) {
        variants.endRecording(0).giveUp();
        throw;
    }
}

Result<bool> ViewFrames::build(const FrameInputs& inputs) {
    if (!host_work_.builds(inputs)) {
        if (auto able = checkAllLights(unitCosts(), inputs.settings, limits().frame); !able) {
            return able.error();
        }
        started_ = Clock::now();
        built_us_ = 0;
        host_work_.start(inputs, work_.host.has_value());
    }
    const auto begun = Clock::now();
    while (!host_work_.built()) {
        host_work_.advance(effects_);
        if (work_.host && Clock::now() - begun >= *work_.host) {
            host_work_.settle();
            return false; // what follows a last stage takes its time, too
        }
    }
    return true;
}

Result<bool> ViewFrames::recordNow(FrameSlot& slot, const FrameInputs& asked, const Slots& slots) {
    const auto start = Clock::now();
    FrameInputs inputs = asked;
    inputs.settings.size = drawnSize(asked.settings);
    const auto built = build(inputs);
    built_us_ += microsSince(start);
    if (!built || !*built) {
        return built;
    }
    if (auto recorded = recordBuilt(slot, inputs, asked, slots); !recorded) {
        return recorded.error();
    }
    return true;
}

Result<void> ViewFrames::recordBuilt(FrameSlot& slot,
                                     const FrameInputs& inputs,
                                     const FrameInputs& asked,
                                     const Slots& slots) {
    const auto start = Clock::now();
    FramePlan plan = host_work_.take();
    if (inputs.settings.list_cap > 0 && plan.lists && host_work_.listStats().overflowed) {
        return tooManyToCap(host_work_.localLightCount());
    }
    if (auto built = effects_.build(plan, {inputs.settings, host_work_.pose(), host_work_.lights(),
                                           inputs.time_s, asked.keep_surfaces});
        !built) {
        return built;
    }
    const SurfacesDrawn surfaces = host_work_.surfaces(plan);
    plan.reused = reusesSurfaces(plan, asked);
    plan.spoil_scratch = plan.reused && inputs.spoil_scratch;
    plan.pose_reused = reusesPose(asked);
    const WorkLimits limits = this->limits();
    const FrameCosts costs =
        host_work_.costs(plan, asked.settings.size, effects_.ofFrame(), unitCosts(), limits);
    prices_ = costs.passes();
    if (auto affordable = costs.check(limits.frame, limits.loop); !affordable) {
        return affordable;
    }
    if (auto taken = takeMemory(slot, plan, asked, slots); !taken) {
        return taken;
    }
    prepareTargets(slot, plan, inputs.settings.size, asked.settings.size);
    prepareBlend(slot, plan);
    slot.material_set = host_work_.pose().materialSet();
    const UploadOffsets offsets = host_work_.upload(slot, effects_.ofFrame());
    prepareParts(slot, plan, offsets);
    const Seconds fine = partOf(timeOf(prices_), limits.piece * piece_share_);
    const Seconds piece = std::max(limits.piece, fine);
    recordFrame(
        {.scene = scene_,
         .slot = slot,
         .plan = plan,
         .draws = host_work_.draws(),
         .offsets = offsets,
         .visibility = plan.visibility ? &slot.material_set->visibility() : nullptr,
         .debug = plan.debug != settings::DebugView::kNone ? &host_work_.debugFrame() : nullptr,
         .effects = effects_.ofFrame(),
         .pieces = slot.pieces,
         .costs = costs},
        piece, fine / piece);
    if (slot.pieces.estimate() > limits.frame) { // with what each piece does again
        markFresh(slot);
        return tooLongInPieces(asked.settings.size, slot.pieces, limits.frame);
    }
    noteDrawn(plan, surfaces);
    noteBuilt(slot, plan, inputs);
    slot.stats.host_us = built_us_ + microsSince(start);
    slot.stats.unpaced_us = Microseconds(slot.pieces.estimate()).count() / pace_.pace;
    slot.submitted = started_;
    beginFlight(slot);
    return {};
}

void ViewFrames::freeTargets() {
    blend_.reset();
    posed_.reset();
    effects_.freeTargets();
    targets_.reset();
}

RenderedFrame ViewFrames::finish(FrameSlot& slot) {
    slot.timestamps.read(slot.stats, slot.pieces.count() > 1);
    if (slot.device_lists) {
        std::string why = std::move(slot.stats.lists.why);
        const uint32_t redraws = slot.stats.lists.redraw_count;
        slot.stats.lists =
            listStats(slot.assignment->totals(), slot.assignment->frame().light_count,
                      slot.assignment->frame().cluster_count);
        slot.stats.lists.why = std::move(why);
        slot.stats.lists.redraw_count = redraws;
    }
    if (slot.counts_pairs) {
        slot.stats.pairs = slot.pairs->read();
    }
    if (slot.counts_overflow) {
        slot.stats.peel.overflow_count = slot.overflow->read();
    }
    if (slot.counts_samples) {
        const auto& drawn = slot.targets->size;
        scene_.overdraw = static_cast<double>(slot.samples->read()) /
                          (static_cast<double>(drawn.width_px) * drawn.height_px);
    }
    for (const auto& [place, effect] : slot.effects) {
        effect->addResults(slot, slot.stats);
    }
    slot.stats.frame_us = microsSince(slot.submitted);
    slot.readback->leased = true;
    const auto& size = slot.targets->shown;
    const PixelView pixels{.data = slot.readback->buffer.mapped,
                           .width_px = size.width_px,
                           .height_px = size.height_px,
                           .stride_bytes = size_t{4} * size.width_px,
                           .radiance =
                               reinterpret_cast<const float*>(slot.readback->radiance.mapped),
                           .radiance_samples = slot.targets->size.width_px / size.width_px};
    return {.pixels = PixelLease(pixels, [readback = slot.readback] { readback->leased = false; }),
            .stats = slot.stats};
}

} // namespace froxel::render
