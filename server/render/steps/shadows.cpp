#include "render/steps/shadows.h"

#include "core/assert.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "interface/shadow_io.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/host_copies.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/shadow_maps.h"
#include "render/steps/view_steps.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <optional>
#include <vector>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;
using Type = vk::DescriptorType;

// Lights with maps; maps, six for a point light; those of them that hold what they would show; and
// casters, as they are sent to the rasteriser.
constexpr std::array kShadowStats = {
    StatRow{"shadows", "lights", "lights"}, StatRow{"shadows", "maps", "maps"},
    StatRow{"shadows", "kept", "maps_kept"}, StatRow{"shadows", "draws", ""},
    StatRow{"shadows", "triangles", "triangles"}};

// A lookup of a light at a pixel. Measured on lavapipe on two cores and on an H200.
constexpr Measured<double> kShadowPair{6e-8, 3e-11};

uint32_t tilesFor(const settings::Shadows& settings, uint32_t light_count) {
    return 6 * std::clamp(light_count, 1U, settings.light_count);
}

vk::Extent2D extentOf(uint32_t tile_count, uint32_t size_px) {
    const uint32_t rows = (tile_count + io::kShadowColumns - 1) / io::kShadowColumns;
    return {std::min(tile_count, io::kShadowColumns) * size_px, rows * size_px};
}

vk::Rect2D tileOf(const ShadowFace& face, uint32_t size_px) {
    return {{static_cast<int32_t>(face.tile % io::kShadowColumns * size_px),
             static_cast<int32_t>(face.tile / io::kShadowColumns * size_px)},
            {size_px, size_px}};
}

// The atlas that `light_count` point lights have, or as many as the settings allow.
gpu::ImageInfo atlasImage(const settings::Shadows& settings, uint32_t light_count) {
    using Usage = vk::ImageUsageFlagBits;
    return {.format = Pipelines::kDepthFormat,
            .extent = extentOf(tilesFor(settings, light_count), settings.size_px),
            .usage = Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc,
            .aspect = vk::ImageAspectFlagBits::eDepth};
}

// What passes surfaces that transmit light, of such an atlas.
gpu::ImageInfo transmittanceImage(const settings::Shadows& settings, uint32_t light_count) {
    using Usage = vk::ImageUsageFlagBits;
    return {.format = Pipelines::kTransmittanceFormat,
            .extent = extentOf(tilesFor(settings, light_count), settings.size_px),
            .usage = Usage::eColorAttachment | Usage::eSampled};
}

// What maps were drawn from: equal faces need no drawing.
struct ShadowsDrawn {
    ShadowFrame frame;
    uint64_t pose = 0; // ScenePose::number(), of what bends
};

// Tiles of shadows.size_px in rows of io::kShadowColumns.
struct ShadowTargets final : StepTargets {
    ShadowTargets(const gpu::Device& device,
                  const settings::Shadows& settings,
                  uint32_t light_count,
                  bool transmits)
        : size_px(settings.size_px), tile_count(tilesFor(settings, light_count)), arena(device),
          atlas(arena.makeImage(atlasImage(settings, light_count), "shadow atlas")) {
        if (transmits) {
            transmittance =
                arena.makeImage(transmittanceImage(settings, light_count), "transmittance atlas");
        }
    }

    [[nodiscard]] bool
    fits(const settings::Shadows& settings, uint32_t light_count, bool transmits) const {
        return size_px == settings.size_px && tile_count == tilesFor(settings, light_count) &&
               (*transmittance.handle != vk::Image{}) == transmits;
    }
    void forEachImage(const Visit& visit) const override {
        visit(atlas, vk::ImageAspectFlagBits::eDepth);
        visit(transmittance, vk::ImageAspectFlagBits::eColor); // of an absent one: nothing
    }
    void forgetDrawn() override { drawn.reset(); }

    uint32_t size_px;
    uint32_t tile_count;
    gpu::MemoryArena arena;
    gpu::Image atlas;
    gpu::Image transmittance;          // null handle: no caster lets light pass
    std::optional<ShadowsDrawn> drawn; // that it holds once what is submitted has run
};

vk::raii::DescriptorPool makeShadowsPool(const gpu::Device& device) {
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const auto& [type, texels] : kFrameBindings) {
        sizes.push_back({type, 1});
    }
    return gpu::makeDescriptorPool(device, sizes);
}

// One a frame slot: what the map's vertex shader reads, as a frame set of its own.
struct ShadowSet {
    ShadowSet(const gpu::Device& device, vk::DescriptorSetLayout frame_layout)
        : pool(makeShadowsPool(device)), set(gpu::makeSet(device, pool, frame_layout)) {}

    // io::Frame at an offset of a buffer.
    void write(const gpu::Device& device, vk::Buffer upload, vk::DeviceSize uniforms) const;

    vk::raii::DescriptorPool pool;
    vk::raii::DescriptorSet set;
};

void ShadowSet::write(const gpu::Device& device, vk::Buffer upload, vk::DeviceSize uniforms) const {
    // All but the uniforms is described as none: lavapipe binds whole sets.
    const vk::DescriptorBufferInfo frame{upload, uniforms, sizeof(io::Frame)};
    const vk::DescriptorBufferInfo no_buffer{.buffer = {}, .range = VK_WHOLE_SIZE};
    const vk::DescriptorImageInfo no_image{.imageView = {},
                                           .imageLayout = vk::ImageLayout::eGeneral};
    const vk::BufferView no_view;
    std::array<vk::WriteDescriptorSet, io::kFrameBindingCount> writes;
    for (uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = {.dstSet = *set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = kFrameBindings[i].type,
                     .pImageInfo = &no_image,
                     .pBufferInfo = i == 0 ? &frame : &no_buffer,
                     .pTexelBufferView = &no_view};
    }
    device.handle().updateDescriptorSets(writes, {});
}

// Where no surface that transmits light is: all passes, and none is near.
vk::ClearValue allPasses() {
    return vk::ClearColorValue(std::array{1.0F, 1.0F, 1.0F, 0.0F});
}

class Shadows final : public Step {
  public:
    explicit Shadows(SceneResources& scene) : scene_(scene) {}

    void look(const StepInputs& inputs, FrameFacts& facts) override {
        buildShadows(scene_, inputs.pose, inputs.lights, inputs.settings, inputs.time_s, frame_);
        if (!frame_.commands.empty()) { // else nothing stands before any light
            facts.lights |= io::kLightShadows;
            facts.lights |= frame_.transmits() ? io::kLightTransmitted : 0U;
        }
    }
    void addLoad(const UnitCosts& unit, CostInputs& load) const override {
        load.costly_lights.push_back({.count = static_cast<uint32_t>(frame_.lights.size()),
                                      .pair = onDevice(unit, kShadowPair)});
    }
    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        if (!changed_.empty()) {
            passes.push_back(
                {pass::kShadows, static_cast<double>(changed_.size()) * faceTime(costs)});
        }
    }
    void addMemory(NeedList& need) const override {
        if (drawn_ || targets_) {
            need.image("shadow atlas", atlasImage(settings_, caster_count_));
            if (frame_.transmits()) {
                need.image("transmittance atlas", transmittanceImage(settings_, caster_count_));
            }
        }
    }
    void gather(FrameUpload& upload, FrameBlocks& blocks) override;
    void addStats(FrameStats& stats) const override {
        if (frame_.lights.empty()) {
            return;
        }
        const std::array<size_t, kShadowStats.size()> values = {
            frame_.lights.size(), frame_.faces.size(), frame_.faces.size() - changed_.size(),
            frame_.commands.size(), frame_.triangle_count};
        for (size_t i = 0; i < values.size(); ++i) {
            stats.steps.set(kShadowStats[i], static_cast<double>(values[i]));
        }
    }

    void freeUnfit(const ViewTargets* /*view*/) override {
        if (targets_ && !targets_->fits(settings_, caster_count_, frame_.transmits())) {
            targets_.reset();
        }
    }
    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;
    void record(const FrameContext& frame) const override;

    [[nodiscard]] ShadowAtlas copy() const;

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        settings_ = inputs.settings.shadows;
        caster_count_ = static_cast<uint32_t>(inputs.lights.lights.size());
        drawn_ = (plan().way & kShadowsDrawn) != 0;
        if (!drawn_) {
            frame_.clear();
        }
        pose_ = inputs.pose.number();
        keeps_ = inputs.keeps;
        chooseFaces();
        return {};
    }
    // Into changed_: those that the atlas does not hold.
    void chooseFaces();
    // Of a map.
    [[nodiscard]] Seconds faceTime(const FrameCosts& costs) const;
    void
    recordFaces(const FrameContext& frame, std::span<const ShadowFace> faces, bool first) const;
    // Of the casters that transmit light, into a colour, or of the others. clears: their tiles.
    void recordCasters(const FrameContext& frame,
                       std::span<const ShadowFace> faces,
                       std::span<const vk::RenderingAttachmentInfo> colors,
                       const vk::RenderingAttachmentInfo& depth,
                       bool clears) const;
    void drawFace(const FrameContext& frame,
                  const ShadowFace& face,
                  uint32_t size_px,
                  bool transmissive) const;

    SceneResources& scene_;
    settings::Shadows settings_;
    uint32_t caster_count_ = 0; // lights that may have maps
    bool drawn_ = false;
    bool keeps_ = false;
    uint64_t pose_ = 0;
    ShadowFrame frame_;
    std::vector<ShadowFace> changed_; // of its faces, to draw
    vk::DeviceSize uniforms_offset_ = 0;
    vk::DeviceSize rows_offset_ = 0;
    vk::DeviceSize commands_offset_ = 0;
    std::shared_ptr<ShadowTargets> targets_; // null: none drawn yet that the settings still ask for
};

void Shadows::chooseFaces() {
    changed_.clear();
    const bool holds = keeps_ && targets_ &&
                       targets_->fits(settings_, caster_count_, frame_.transmits()) &&
                       !targets_->fresh && targets_->drawn;
    for (size_t i = 0; i < frame_.faces.size(); ++i) {
        const ShadowFace& face = frame_.faces[i];
        if (!holds || !sameFace(frame_, targets_->drawn->frame, i) ||
            (face.bends && targets_->drawn->pose != pose_)) {
            changed_.push_back(face);
        }
    }
}

void Shadows::gather(FrameUpload& upload, FrameBlocks& blocks) {
    if (!drawn_) {
        return;
    }
    const auto place = [&](size_t binding, auto span) {
        blocks[binding] = {upload.add(span), span.size_bytes()};
    };
    place(io::kShadowOfLightBinding, std::span<const uint32_t>(frame_.shadow_of_light));
    place(io::kShadowLightsBinding, std::span<const io::ShadowLight>(frame_.lights));
    uniforms_offset_ = upload.add(std::span<const io::Frame>(&frame_.uniforms, 1));
    rows_offset_ = upload.add(std::span<const InstanceRows>(frame_.rows));
    commands_offset_ = upload.add(std::span<const vk::DrawIndexedIndirectCommand>(frame_.commands));
}

void Shadows::prepare(FrameSlot& slot, FrameBlocks& blocks) {
    if (!drawn_) {
        return;
    }
    if (!targets_) {
        targets_ = std::make_shared<ShadowTargets>(scene_.shared.device, settings_, caster_count_,
                                                   frame_.transmits());
    }
    slot.step_targets.hold(targets_);
    blocks[io::kShadowAtlasBinding].image = *targets_->atlas.view;
    blocks[io::kTransmittanceAtlasBinding].image = *targets_->transmittance.view;
    slot.stored.findOrMake<ShadowSet>(scene_.shared.device, scene_.shared.pipelines.frameLayout())
        .write(scene_.shared.device, slot.upload.buffer(), uniforms_offset_);
}

Seconds Shadows::faceTime(const FrameCosts& costs) const {
    const auto faces = std::max<size_t>(frame_.faces.size(), 1);
    const double triangles = frame_.triangle_count / static_cast<double>(faces);
    const auto side = static_cast<double>(settings_.size_px);
    return Seconds(triangles * costs.unit().triangle / 2 + side * side * costs.unit().depth_pixel);
}

void Shadows::record(const FrameContext& frame) const {
    if (changed_.empty()) {
        return;
    }
    const Seconds face_time = faceTime(frame.costs);
    const std::span<const ShadowFace> faces = changed_;
    const size_t at_once = frame.pieces.fits(face_time);
    for (size_t first = 0; first < faces.size(); first += at_once) {
        const auto part = faces.subspan(first, std::min(at_once, faces.size() - first));
        frame.pieces.add(static_cast<double>(part.size()) * face_time);
        recordFaces(frame, part, first == 0);
    }
    targets_->drawn.reset();
    if (keeps_) {
        targets_->drawn = {frame_, pose_};
    }
}

void Shadows::recordFaces(const FrameContext& frame,
                          std::span<const ShadowFace> faces,
                          bool first) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kShadows);
    const auto& targets = frame.slot.step_targets.get<ShadowTargets>();
    const bool whole = changed_.size() == frame_.faces.size();
    const auto depth = attachment(
        targets.atlas, first && whole ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
        farDepth());
    recordCasters(frame, faces, {}, depth, !whole);
    std::vector<ShadowFace> transmitting;
    std::ranges::copy_if(faces, std::back_inserter(transmitting), &ShadowFace::transmits);
    if (!transmitting.empty()) {
        nextRasterPass(frame.slot.cmd);
        const auto passes = attachment(targets.transmittance, vk::AttachmentLoadOp::eLoad);
        recordCasters(frame, transmitting, {&passes, 1},
                      attachment(targets.atlas, vk::AttachmentLoadOp::eLoad), true);
    }
}

void Shadows::recordCasters(const FrameContext& frame,
                            std::span<const ShadowFace> faces,
                            std::span<const vk::RenderingAttachmentInfo> colors,
                            const vk::RenderingAttachmentInfo& depth,
                            bool clears) const {
    const bool transmissive = !colors.empty();
    const auto& cmd = frame.slot.cmd;
    const auto& targets = frame.slot.step_targets.get<ShadowTargets>();
    const auto used = static_cast<uint32_t>(frame_.faces.size());
    cmd.beginRendering({.renderArea = {{0, 0}, extentOf(used, targets.size_px)},
                        .layerCount = 1,
                        .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
                        .pColorAttachments = colors.data(),
                        .pDepthAttachment = &depth});
    bindGeometry(frame, frame.scene.shared.pipelines.geometryPipelineLayout(),
                 *frame.slot.stored.get<ShadowSet>().set, *frame.scene.index_buffer.handle,
                 rows_offset_);
    if (clears) {
        std::vector<vk::ClearRect> tiles;
        for (const ShadowFace& face : faces) {
            tiles.push_back({tileOf(face, targets.size_px), 0, 1});
        }
        cmd.clearAttachments(
            transmissive ? vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eColor,
                                               .colorAttachment = 0,
                                               .clearValue = allPasses()}
                         : vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eDepth,
                                               .clearValue = farDepth()},
            tiles);
    }
    cmd.setCullMode(vk::CullModeFlagBits::eNone);
    cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    for (const ShadowFace& face : faces) {
        drawFace(frame, face, targets.size_px, transmissive);
    }
    cmd.endRendering();
}

void Shadows::drawFace(const FrameContext& frame,
                       const ShadowFace& face,
                       uint32_t size_px,
                       bool transmissive) const {
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.pipelines;
    const vk::Rect2D tile = tileOf(face, size_px);
    const auto side = static_cast<float>(size_px);
    cmd.setViewport(0, vk::Viewport{static_cast<float>(tile.offset.x),
                                    static_cast<float>(tile.offset.y), side, side, 0, 1});
    cmd.setScissor(0, tile);
    const auto pass = transmissive ? GeometryPass::kTransmittance : GeometryPass::kDepth;
    for (uint32_t i = face.first_group; i < face.first_group + face.group_count; ++i) {
        const ShadowGroup& group = frame_.groups[i];
        if (isTransmissive(group.material_flags) != transmissive) {
            continue;
        }
        cmd.bindPipeline(vk::PipelineBindPoint::eGraphics,
                         pipelines.geometry(pass, {group.material_flags, 0, 0}));
        if (group.material_flags != 0) {
            cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics,
                                   pipelines.geometryPipelineLayout(), 1,
                                   frame.scene.materialSet(group.material), {});
        }
        constexpr uint32_t kStride = sizeof(vk::DrawIndexedIndirectCommand);
        cmd.drawIndexedIndirect(frame.slot.upload.buffer(),
                                commands_offset_ + vk::DeviceSize{group.first_command} * kStride,
                                group.command_count, kStride);
    }
}

ShadowAtlas Shadows::copy() const {
    FROXEL_ASSERT(targets_, "the last frame drew shadow maps");
    const auto& extent = targets_->atlas.extent;
    ShadowAtlas atlas{targets_->size_px, extent.width, {}, frame_.shadow_of_light, {}};
    for (const auto& light : frame_.lights) {
        atlas.first_tiles.push_back(static_cast<uint32_t>(light.first_tile));
    }
    atlas.depths.resize(size_t{extent.width} * extent.height);
    const vk::DeviceSize bytes = atlas.depths.size() * sizeof(float);
    const Readback readback(scene_.shared.device, {.picture = bytes});
    scene_.shared.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        recordTargetCopy(cmd, targets_->atlas, vk::ImageAspectFlagBits::eDepth, readback.buffer);
    });
    std::memcpy(atlas.depths.data(), readback.buffer.mapped, bytes);
    return atlas;
}

bool looks(const settings::ViewSettings& settings) {
    return settings.shadows.light_count > 0 && !settings::replacesPicture(settings.debug.view);
}

std::optional<StepPlan> planOfShadows(const PlanInputs& inputs) {
    const FrameFacts& facts = inputs.facts;
    const bool drawn = facts.hasLight(io::kLightShadows) && facts.hasLight(io::kLightLocal);
    if (!drawn && inputs.settings.shadows.light_count == 0) {
        return {};
    }
    constexpr uint32_t kFlags = io::kLightShadows | io::kLightTransmitted;
    return drawn ? StepPlan{.way = kShadowsDrawn, .light_flags = facts.lights & kFlags}
                 : StepPlan{};
}

std::vector<Use> usesOfShadows(const FramePlan& /*frame*/, const StepPlan& plan) {
    if ((plan.way & kShadowsDrawn) == 0) {
        return {};
    }
    std::vector uses = {use::vertices(), use::depthTested()};
    uses.back().what = Resource::kAtlas;
    if ((plan.light_flags & io::kLightTransmitted) != 0) {
        uses.push_back(use::drawn(Resource::kAtlas));
    }
    return uses;
}

std::string wordsOfShadows(const PlanInputs& inputs, const StepPlan* plan) {
    if (plan == nullptr || (plan->way & kShadowsDrawn) == 0) {
        return {};
    }
    const settings::ViewSettings& settings = inputs.settings;
    const uint32_t count = settings.shadows.light_count;
    return "shadow maps: up to " + std::to_string(count) + (count == 1 ? " light" : " lights") +
           ", faces of " + std::to_string(settings.shadows.size_px) + " pixels a side";
}

std::optional<std::string> memoryWordsOfShadows(const settings::ViewSettings& settings) {
    if (settings.shadows.light_count == 0) {
        return {};
    }
    return "shadow maps of " + std::to_string(settings.shadows.light_count) + " lights";
}

Result<void> ableTo(const settings::ViewSettings& settings, const gpu::Device& device) {
    const uint32_t limit_px = device.limits().maxImageDimension2D;
    if (settings.shadows.light_count > 0 &&
        io::kShadowColumns * settings.shadows.size_px > limit_px) {
        return Error{ErrorCode::kUnsupported, "shadow_size is " +
                                                  std::to_string(settings.shadows.size_px) +
                                                  "; this device's images allow " +
                                                  std::to_string(limit_px / io::kShadowColumns)};
    }
    return {};
}

} // namespace

const StepRow kShadowsStep{.name = pass::kShadows,
                           .plan = planOfShadows,
                           .uses = usesOfShadows,
                           .words = wordsOfShadows,
                           .make = makeStep<Shadows>,
                           .looks = looks,
                           .able = ableTo,
                           .memory_words = memoryWordsOfShadows,
                           .stats = kShadowStats};

ShadowAtlas copyShadows(const ViewSteps& steps) {
    const Step* shadows = steps.find(kShadowsStep);
    FROXEL_ASSERT(shadows != nullptr, "the view had a frame with shadow maps");
    return static_cast<const Shadows*>(shadows)->copy();
}

} // namespace froxel::render
