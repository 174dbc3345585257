// Counts light-pixel pairs on the device, for frames that ask for it.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/pairs_io.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/lists/counting_flags.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/storage_set.h"
#include "render/steps/order.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace froxel::render {

namespace {

// (light, pixel) pairs that were looped over, and those within the light's radius and cone.
constexpr std::array kPairStats = {StatRow{"pairs", "evaluated", "evaluated"},
                                   StatRow{"pairs", "contributing", "contributing"}};
constexpr const StatRow& kEvaluated = kPairStats[0];
constexpr const StatRow& kContributing = kPairStats[1];

constexpr uint32_t kLit = 1U << 0U; // of StepPlan::way: there is something to count

double join(uint32_t low, uint32_t high) {
    return static_cast<double>(uint64_t{high} << 32U | low);
}

// Shared by every view.
class PairPipelines {
  public:
    explicit PairPipelines(DeviceResources& shared)
        : device_(shared.device), set_layout_(storageLayout(device_, 1)),
          layout_(gpu::makePipelineLayout(
              device_,
              {shared.pipelines.frameLayout(), shared.pipelines.screenLayout(), *set_layout_})),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    [[nodiscard]] vk::Pipeline find(uint32_t light_flags) {
        const uint32_t flags = countingFlags(light_flags, device_.traits().is_cpu);
        return *made_.findOrMake(flags, [=, this] {
            return gpu::makeComputePipeline(
                device_, shaders::count_pairs_comp(),
                {0, flags, 0, std::max(1U, device_.traits().subgroup_size)}, *layout_,
                "count pairs");
        });
    }
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    VariantCache<uint32_t> made_;
};

// One a frame slot, which the host reads.
struct PairCounts {
    PairCounts(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : arena(device), buffer(arena.makeBuffer(sizeof(io::PairCounts),
                                                 vk::BufferUsageFlagBits::eStorageBuffer |
                                                     vk::BufferUsageFlagBits::eTransferDst,
                                                 gpu::MemoryUse::kReadback,
                                                 "pair counts")),
          set(device, layout, 1) {
        set.write(std::array{vk::DescriptorBufferInfo{*buffer.handle, 0, VK_WHOLE_SIZE}});
    }

    gpu::MemoryArena arena;
    gpu::Buffer buffer;
    StorageSet set;
};

class Pairs final : public Step {
  public:
    explicit Pairs(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        if (!lit()) {
            return;
        }
        passes.push_back({pass::kCountPairs, timeOver(cost(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return lit() ? costs.unit().counting.loop : 0;
    }
    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        if (lit()) {
            (void)slot.stored.findOrMake<PairCounts>(
                scene_.shared.device, scene_.shared.stored<PairPipelines>().setLayout());
        }
    }
    // Without lights: as none.
    void addStats(FrameStats& stats) const override {
        stats.steps.set(kEvaluated, 0);
        stats.steps.set(kContributing, 0);
    }
    void record(const FrameContext& frame) const override {
        if (!lit()) {
            return;
        }
        const auto& cmd = frame.slot.cmd;
        cmd.fillBuffer(*frame.slot.stored.get<PairCounts>().buffer.handle, 0, VK_WHOLE_SIZE, 0);
        computeAfterTransfer(cmd);
        inParts(frame, frame.drawn(), cost(frame.costs), recordPart);
    }
    void addResults(const FrameSlot& slot, const StepPlan& its, FrameStats& stats) const override {
        if ((its.way & kLit) == 0) {
            return;
        }
        io::PairCounts counts{};
        std::memcpy(&counts, slot.stored.get<PairCounts>().buffer.mapped, sizeof(counts));
        stats.steps.set(kEvaluated, join(counts.evaluated_low, counts.evaluated_high));
        stats.steps.set(kContributing, join(counts.contributing_low, counts.contributing_high));
    }

  private:
    [[nodiscard]] bool lit() const { return (plan().way & kLit) != 0; }
    static RegionCost cost(const FrameCosts& costs) { return costs.shading(costs.unit().counting); }
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const auto& cmd = frame.slot.cmd;
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kCountPairs);
        auto& pipelines = frame.scene.shared.stored<PairPipelines>();
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute,
                         pipelines.find(frame.plan.lighting_light_flags));
        const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                                 frame.slot.stored.get<PairCounts>().set.handle()};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0, sets, {});
        dispatchOver(cmd, part);
    }

    SceneResources& scene_;
};

} // namespace

const StepRow kPairsStep{
    .name = pass::kCountPairs,
    .plan =
        [](const PlanInputs& inputs) {
            const uint32_t way = inputs.facts.hasLight(io::kLightLocal) ? kLit : 0U;
            return inputs.settings.count_pairs ? std::optional(StepPlan{.way = way}) : std::nullopt;
        },
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kDepth), use::sampled(Resource::kLists)};
        },
    .words =
        [](const PlanInputs& inputs, const StepPlan* plan) {
            const bool counts = plan != nullptr && (plan->way & kLit) != 0;
            return std::string(counts && !settings::replacesPicture(inputs.plan.debug)
                                   ? "a separate pass counts (light, pixel) pairs"
                                   : "");
        },
    .make = makeStep<Pairs>,
    .stats = kPairStats};

} // namespace froxel::render
