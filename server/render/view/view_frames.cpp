#include "render/view/view_frames.h"

#include "render/frame/fresh_targets.h"
#include "render/frame/record.h"
#include "render/view/memory_need.h"
#include "render/view/refusals.h"

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
                                    const FrameSize& size,
                                    const Slots& slots) {
    host_work_.gather(slot.upload, steps_.ofFrame());
    target_needs_ = targetNeeds(plan, size, targets_.get());
    FrameMemory frame = frameMemory(host_work_, slot.inputs, size, target_needs_, steps_.ofFrame());
    letGo(slots, slot, frame);
    if (auto taken = take(memory_, frame, scene_.shared.device, pictureWords(slot.inputs.settings));
        !taken) {
        host_work_.lightWork().letGo();
        return taken;
    }
    // What does not fit goes before anything else is made; frames in flight keep theirs.
    if (targets_ && !targets_->fits(size, target_needs_)) {
        targets_.reset();
    }
    steps_.freeUnfit(targets_.get());
    return {};
}

bool ViewFrames::holdsSurfaces(const FramePlan& plan, const FrameSize& size) const {
    return targets_ && !targets_->fresh && leavesSurfaces(plan) &&
           targets_->surfaces == host_work_.surfaces(plan) &&
           targets_->fits(size, targetNeeds(plan, size, targets_.get()));
}

void ViewFrames::noteDrawn(const FramePlan& plan, const SurfacesDrawn& surfaces) {
    targets_->surfaces.reset();
    if (leavesSurfaces(plan)) {
        targets_->surfaces = surfaces;
    }
}

void ViewFrames::prepareTargets(FrameSlot& slot, const FramePlan& plan, const FrameSize& size) {
    if (!targets_) {
        targets_ = std::make_shared<ViewTargets>(scene_.shared.device, size, target_needs_);
    }
    targets_->rastered_in_compute = plan.geometry == SolidGeometry::kComputeIds;
    slot.targets = targets_;
    slot.makeReadback(scene_.shared.device, readbackBytes(size, slot.inputs));
    const bool filtered = plan.uses(Resource::kDisplay);
    writeScreenSet(scene_.shared.device, slot,
                   packedPixels(slot, filtered ? Resource::kDisplay : Resource::kPixels));
}

void ViewFrames::noteBuilt(FrameSlot& slot, const FramePlan& plan, const FrameInputs& inputs) {
    slot.stats = {};
    slot.stats.surfaces_reused = reusesSurfaces(plan);
    slot.stats.triangle_count = host_work_.draws().triangle_count;
    slot.stats.draw_count = static_cast<uint32_t>(host_work_.draws().commands.size());
    slot.steps.assign(steps_.ofFrame().begin(), steps_.ofFrame().end());
    for (const ActiveStep& active : slot.steps) {
        active.step->addStats(slot.stats);
    }
    slot.stats.lists = host_work_.lightWork().stats();
    slot.stats.details = details_.update(
        inputs.settings, host_work_.plannedFacts(), plan, scene_.needs,
        *scene_.shared.device.memoryLedger(),
        plan.debug != settings::DebugView::kNone ? &host_work_.debugFrame().legend : nullptr);
    slot.stats.grid = host_work_.lightWork().grid().stats();
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
            host_work_.lightWork().forgetSeen();
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
        host_work_.advance(steps_);
        if (work_.host && Clock::now() - begun >= *work_.host) {
            host_work_.settle();
            return false; // what follows a last stage takes its time, too
        }
    }
    return true;
}

Result<bool> ViewFrames::recordNow(FrameSlot& slot, const FrameInputs& asked, const Slots& slots) {
    const auto start = Clock::now();
    const FrameSize size = frameSize(asked.settings);
    FrameInputs inputs = asked;
    inputs.settings.size = size.drawn;
    const auto built = build(inputs);
    built_us_ += microsSince(start);
    if (!built || !*built) {
        return built;
    }
    if (auto recorded = recordBuilt(slot, inputs, size, slots); !recorded) {
        return recorded.error();
    }
    return true;
}

Result<void> ViewFrames::recordBuilt(FrameSlot& slot,
                                     const FrameInputs& inputs,
                                     const FrameSize& size,
                                     const Slots& slots) {
    const auto start = Clock::now();
    FramePlan plan = host_work_.take();
    if (inputs.settings.list_cap > 0 && plan.lists && host_work_.lightWork().stats().overflowed) {
        return tooManyToCap(static_cast<uint32_t>(host_work_.lightWork().lights().lights.size()));
    }
    const SurfacesDrawn surfaces = host_work_.surfaces(plan);
    const bool reused = inputs.keep_surfaces && holdsSurfaces(plan, size);
    if (reused) {
        plan.reuse(kSurfaceResources);
    }
    if (auto begun = steps_.begin(plan, host_work_.stepInputs()); !begun) {
        return begun;
    }
    const WorkLimits limits = this->limits();
    const FrameCosts costs = host_work_.costs(plan, size, steps_.ofFrame(), unitCosts(), limits);
    prices_ = costs.passes();
    if (auto affordable = costs.check(limits.frame, limits.loop); !affordable) {
        return affordable;
    }
    if (auto taken = takeMemory(slot, plan, size, slots); !taken) {
        return taken;
    }
    prepareTargets(slot, plan, size);
    slot.material_set = host_work_.pose().materialSet();
    slot.visibility =
        plan.byIds()
            ? &slot.material_set->visibility(scene_.detailOf(inputs.settings.geometry_error_px))
            : nullptr;
    host_work_.upload(slot, steps_.ofFrame());
    const Seconds fine = partOf(timeOf(prices_), limits.piece * piece_share_);
    const Seconds piece = std::max(limits.piece, fine);
    recordFrame({.scene = scene_,
                 .slot = slot,
                 .plan = plan,
                 .draws = host_work_.draws(),
                 .visibility = slot.visibility,
                 .steps = steps_.ofFrame(),
                 .pieces = slot.pieces,
                 .costs = costs,
                 .spoil_scratch = reused && inputs.spoil_scratch},
                piece, fine / piece);
    if (slot.pieces.estimate() > limits.frame) { // with what each piece does again
        markFresh(slot);
        return tooLongInPieces(size.shown, slot.pieces, limits.frame);
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
    steps_.freeTargets();
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
    for (const ActiveStep& active : slot.steps) {
        if (!active.reused) {
            active.step->addResults(slot, active.plan, slot.stats);
        }
    }
    slot.stats.frame_us = microsSince(slot.submitted);
    slot.readback->leased = true;
    const auto& [drawn, shown] = slot.targets->size;
    const std::byte* host = slot.readback->buffer.mapped;
    PixelView pixels{.width_px = shown.width_px,
                     .height_px = shown.height_px,
                     .output_samples = drawn.width_px / shown.width_px};
    if (slot.inputs.form.jpeg) {
        pixels.jpeg = jpegFile(JpegSizes(shown, *slot.inputs.form.jpeg), host);
    } else if (slot.inputs.form.plane_sampling > 0) {
        pixels.planes = PlaneSizes(shown, slot.inputs.form.plane_sampling).view(host);
    } else {
        pixels.data = host;
        pixels.stride_bytes = size_t{4} * shown.width_px;
    }
    for (size_t i = 0; i < kOutputCount; ++i) {
        pixels.outputs[i] = reinterpret_cast<const float*>(slot.readback->outputs[i].mapped);
    }
    return {.pixels = PixelLease(pixels, [readback = slot.readback] { readback->leased = false; }),
            .stats = slot.stats};
}

} // namespace froxel::render
