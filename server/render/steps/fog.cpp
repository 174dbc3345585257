#include "render/steps/fog.h"

#include "cluster/depth_range.h"
#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/storage_set.h"
#include "render/steps/environment.h"
#include "render/steps/fog_plan.h"
#include "render/steps/order.h"
#include "render/surfaces/screen_pass.h"

#include <array>

namespace froxel::render {

namespace {

constexpr Measured<PairCost> kPair{.cpu = {5e-9, 8e-7}, .gpu = {8e-12, 1e-6}};
constexpr Measured<double> kFroxel{.cpu = 6e-8, .gpu = 1e-10}; // without lights

enum class FogShader : uint8_t { kScatter, kIntegrate, kApply };

// Shared by every view; a pipeline is made when first needed.
class FogPipelines {
  public:
    explicit FogPipelines(DeviceResources& shared)
        : device_(shared.device), screen_layout_(shared.pipelines.screenPipelineLayout()),
          set_layout_(storageLayout(device_, 1)),
          volume_layout_(
              gpu::makePipelineLayout(device_, {shared.pipelines.frameLayout(), *set_layout_})),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    [[nodiscard]] vk::Pipeline pipeline(FogShader shader, const VariantKey& key);
    // Of set 1 where the volume is written.
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    // kApply has the screen passes' layout.
    [[nodiscard]] vk::PipelineLayout volumeLayout() const { return *volume_layout_; }

  private:
    const gpu::Device& device_;
    vk::PipelineLayout screen_layout_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout volume_layout_;
    VariantCache<std::pair<FogShader, VariantKey>> made_;
};

vk::Pipeline FogPipelines::pipeline(FogShader shader, const VariantKey& key) {
    return *made_.findOrMake(std::pair(shader, key), [=, this] {
        const auto constants = specConstants(key, device_.traits());
        switch (shader) {
        case FogShader::kScatter:
            return gpu::makeComputePipeline(device_, shaders::fog_scatter_comp(), constants,
                                            *volume_layout_, "fog scatter");
        case FogShader::kIntegrate:
            return gpu::makeComputePipeline(device_, shaders::fog_integrate_comp(), constants,
                                            *volume_layout_, "fog integrate");
        case FogShader::kApply:
            break;
        }
        return gpu::makeComputePipeline(device_, shaders::fog_comp(), constants, screen_layout_,
                                        "fog");
    });
}

// One view's froxels.
class FogVolume final : public StepTargets {
  public:
    FogVolume(const gpu::Device& device, vk::DescriptorSetLayout layout, uint64_t bytes)
        : arena_(device),
          froxels_(arena_.makeBuffer(bytes,
                                     vk::BufferUsageFlagBits::eStorageBuffer |
                                         vk::BufferUsageFlagBits::eUniformTexelBuffer,
                                     gpu::MemoryUse::kDevice,
                                     "fog volume")),
          set_(device, layout, 1) {
        set_.write(std::array{vk::DescriptorBufferInfo{*froxels_.handle, 0, VK_WHOLE_SIZE}});
    }

    [[nodiscard]] const gpu::Buffer& froxels() const { return froxels_; }
    [[nodiscard]] vk::DescriptorSet set() const { return set_.handle(); }

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer froxels_;
    StorageSet set_;
};

class Fog final : public Step {
  public:
    explicit Fog(SceneResources& scene) : scene_(scene) {}

    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        const auto& settings = inputs.settings;
        const auto lit = cluster::litDepthRange(inputs.lights, settings.camera,
                                                inputs.pose.boundsWorld(), cluster::Lit::kMedium);
        fog_ = makeFog(settings, lit.far_m, inputs.time_s);
        if (hasEnvironment(settings)) {
            const auto map = scene_.stored<EnvironmentMaps>().find(settings.environment.light);
            if (!map) {
                return map.error();
            }
            fog_.ambient = glm::vec3((*map)->seen->mean()) * settings.environment.strength;
        }
        return checkFroxels(fog_, scene_.shared.device.limits().maxTexelBufferElements);
    }

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        if (hasVolume()) {
            passes.push_back({pass::kFogScatter, timeOver(scatterCost(costs), nodes())});
        }
        passes.push_back({pass::kFog, timeOver(costs.screen(), costs.load().size.drawn)});
    }
    double loopCost(const FrameCosts& costs) const override {
        return hasVolume() ? pairCost(costs.unit()).loop : 0;
    }
    void addMemory(NeedList& need) const override { need.buffer("fog volume", volumeBytes()); }
    void gather(FrameUpload& upload, FrameBlocks& blocks) override {
        blocks[io::kFogBinding] = {upload.add(std::span<const io::Fog>(&fog_, 1)), sizeof(fog_)};
    }

    void freeUnfit(const ViewTargets* /*view*/) override {
        if (volume_ && volume_->froxels().size_bytes != volumeBytes()) {
            volume_.reset();
        }
    }
    void freeTargets() override { volume_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;

    void record(const FrameContext& frame) const override;

  private:
    [[nodiscard]] bool hasVolume() const { return (plan().way & kFogVolume) != 0; }
    [[nodiscard]] uint64_t volumeBytes() const {
        return hasVolume() ? kFroxelBytes * froxelCount(fog_) : 0;
    }
    [[nodiscard]] settings::Size nodes() const { return {fog_.node_count_x, fog_.node_count_y}; }
    // A CPU device's cores go through a node's slices one after another.
    [[nodiscard]] PairCost pairCost(const UnitCosts& unit) const {
        PairCost cost = onDevice(unit, kPair);
        cost.loop *= unit.is_cpu ? fog_.slice_count : 1;
        return cost;
    }
    [[nodiscard]] RegionCost scatterCost(const FrameCosts& costs) const; // over the nodes
    static void bindVolume(const FrameContext& frame, FogShader shader, const VariantKey& key);
    void recordVolume(const FrameContext& frame) const;
    void recordScatter(const FrameContext& frame, const vk::Rect2D& nodes) const;
    void recordIntegrate(const FrameContext& frame) const;
    void recordApply(const FrameContext& frame, const vk::Rect2D& region) const;

    SceneResources& scene_;
    io::Fog fog_{};
    std::shared_ptr<FogVolume> volume_; // null: the last frame has none
};

RegionCost Fog::scatterCost(const FrameCosts& costs) const {
    const PairCost pair = pairCost(costs.unit());
    const double froxel = onDevice(costs.unit(), kFroxel);
    return {Seconds(0),
            [&costs, &fog = fog_, pair, froxel](const vk::Rect2D& nodes) {
                const uint32_t tile = fog.tile_px;
                const auto& drawn = costs.load().size.drawn;
                const vk::Rect2D whole{{0, 0}, {drawn.width_px, drawn.height_px}};
                const vk::Rect2D region =
                    common(whole, {{nodes.offset.x * static_cast<int32_t>(tile),
                                    nodes.offset.y * static_cast<int32_t>(tile)},
                                   {nodes.extent.width * tile, nodes.extent.height * tile}});
                // Pairs are of the tiles' pixels, and a tile has one froxel a slice.
                const double each = fog.slice_count / (static_cast<double>(tile) * tile);
                return Seconds(areaOf(nodes) * fog.slice_count * froxel +
                               each * costs.lit(region, pair));
            },
            costs.loop(pair)};
}

void Fog::prepare(FrameSlot& slot, FrameBlocks& blocks) {
    if (!hasVolume()) {
        return;
    }
    if (!volume_) {
        volume_ = std::make_shared<FogVolume>(
            scene_.shared.device, scene_.shared.stored<FogPipelines>().setLayout(), volumeBytes());
    }
    slot.step_targets.hold(volume_);
    blocks[io::kFogVolumeBinding] = {.bytes = volumeBytes(), .buffer = *volume_->froxels().handle};
}

void Fog::record(const FrameContext& frame) const {
    if (hasVolume()) {
        recordVolume(frame);
    }
    inParts(frame, frame.drawn(), frame.costs.screen(),
            [this](const FrameContext& at, const vk::Rect2D& part) { recordApply(at, part); });
}

void Fog::recordVolume(const FrameContext& frame) const {
    inParts(frame, nodes(), scatterCost(frame.costs),
            [this](const FrameContext& at, const vk::Rect2D& part) { recordScatter(at, part); });
    nextComputePass(frame.slot.cmd); // the slices' scattering -> their sums, in place
    recordIntegrate(frame);
    nextComputePass(frame.slot.cmd); // the sums -> texel loads of the last pass
}

void Fog::bindVolume(const FrameContext& frame, FogShader shader, const VariantKey& key) {
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.stored<FogPipelines>();
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines.pipeline(shader, key));
    const std::array sets = {*frame.slot.frame_set, frame.slot.step_targets.get<FogVolume>().set()};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.volumeLayout(), 0, sets, {});
}

// Reads lights and lists; writes the volume.
void Fog::recordScatter(const FrameContext& frame, const vk::Rect2D& nodes) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kFogScatter);
    const uint32_t noise = (plan().way & kFogNoise) != 0 ? io::kOutputFogNoise : 0U;
    const uint32_t lights = fogLightFlags(frame.plan.forward_light_flags) & ~io::kLightDirectional;
    bindVolume(frame, FogShader::kScatter, {0, lights, noise});
    dispatchOver(frame.slot.cmd, nodes, fog_.slice_count);
}

// Adds it up from front to back.
void Fog::recordIntegrate(const FrameContext& frame) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kFogIntegrate);
    bindVolume(frame, FogShader::kIntegrate, {});
    frame.slot.cmd.dispatch(screenGroups(fog_.node_count_x), screenGroups(fog_.node_count_y), 1);
}

// Reads volume and depth; radiance is seen through fog.
void Fog::recordApply(const FrameContext& frame, const vk::Rect2D& region) const {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kFog);
    const uint32_t lights = fogLightFlags(frame.plan.forward_light_flags) & io::kLightDirectional;
    bindScreen(frame, vk::PipelineBindPoint::eCompute,
               frame.scene.shared.stored<FogPipelines>().pipeline(
                   FogShader::kApply, {0, lights, plan().blended_output_flags}));
    dispatchOver(frame.slot.cmd, region);
}

std::optional<StepPlan> planOfFog(const PlanInputs& inputs) {
    const settings::Fog& fog = inputs.settings.fog;
    if (!fog.present()) {
        return {};
    }
    StepPlan plan{.blended_output_flags = io::kOutputFog};
    if (fog.scatters() && inputs.facts.hasLight(io::kLightLocal)) {
        plan.way = kFogVolume | (fog.noise ? kFogNoise : 0U);
        plan.blended_output_flags |= io::kOutputFogVolume;
    }
    return plan;
}

std::vector<Use> usesOfFog(const FramePlan& /*frame*/, const StepPlan& plan) {
    std::vector uses = {use::sampled(Resource::kDepth), use::stored(Resource::kRadiance)};
    if ((plan.way & kFogVolume) != 0) {
        uses.push_back(use::sampled(Resource::kLists));
        uses.push_back(use::sampled(Resource::kAtlas));
        uses.push_back(use::stored(Resource::kFroxels));
    }
    return uses;
}

std::string wordsOfFog(const PlanInputs& /*inputs*/, const StepPlan* plan) {
    if (plan == nullptr) {
        return {};
    }
    return (plan->way & kFogVolume) != 0 ? "fog: two passes scatter lights in a froxel volume with "
                                           "the same lists, and one pass applies it to the picture"
                                         : "fog: no light to scatter, no froxel volume; one pass "
                                           "applies the fog to the picture";
}

} // namespace

const StepRow kFogStep{.name = pass::kFog,
                       .part = StepPart::kPicture,
                       .plan = planOfFog,
                       .uses = usesOfFog,
                       .words = wordsOfFog,
                       .make = makeStep<Fog>,
                       .lights_medium = [](const settings::ViewSettings& settings) {
                           return settings.fog.scatters();
                       }};

} // namespace froxel::render
