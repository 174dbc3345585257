// Packed pixels become planes of luma and chroma on their way to the host, in the integers of
// libjpeg: half as many bytes in 4:2:0, and nothing to convert there.
#include "render/frame/planes.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/storage_set.h"
#include "render/pipelines/variant_cache.h"
#include "render/steps/order.h"

#include <array>

namespace froxel::render {

namespace {

constexpr uint32_t kPlanesBindings = 2; // storage buffers: pixels, planes

// Shared by every view.
class PlanesPipelines {
  public:
    explicit PlanesPipelines(DeviceResources& shared)
        : device_(shared.device), set_layout_(storageLayout(device_, kPlanesBindings)),
          layout_(gpu::makePipelineLayout(device_, {*set_layout_}, sizeof(io::PlanesPicture))),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    // May throw VariantsMissing.
    [[nodiscard]] vk::Pipeline pipeline(uint32_t sampling) {
        return *made_.findOrMake(sampling, [=, this] {
            return gpu::makeComputePipeline(device_, shaders::planes_comp(), {sampling}, *layout_,
                                            pass::kPlanes);
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

// One view's.
struct PlanesTargets final : StepTargets {
    PlanesTargets(const gpu::Device& device, uint64_t bytes)
        : arena(device), planes(arena.makeBuffer(bytes,
                                                 vk::BufferUsageFlagBits::eStorageBuffer |
                                                     vk::BufferUsageFlagBits::eTransferSrc,
                                                 gpu::MemoryUse::kDevice,
                                                 "planes")) {}

    gpu::MemoryArena arena;
    gpu::Buffer planes;
};

// One a frame slot.
struct PlanesSet : StorageSet {
    PlanesSet(const gpu::Device& device, vk::DescriptorSetLayout layout)
        : StorageSet(device, layout, kPlanesBindings) {}
};

class Planes final : public Step {
  public:
    explicit Planes(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kPlanes, timeOf(costs)});
    }
    void addMemory(NeedList& need) const override { need.buffer("planes", sizes_.bytes()); }
    void freeUnfit(const ViewTargets* /*view*/) override {
        if (targets_ && targets_->planes.size_bytes != sizes_.bytes()) {
            targets_.reset();
        }
    }
    void freeTargets() override { targets_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;
    void record(const FrameContext& frame) const override;

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        sampling_ = inputs.form.plane_sampling;
        sizes_ = PlaneSizes(inputs.size.shown, sampling_);
        return {};
    }
    // Converted, and copied to the host, if that is not beside the frame.
    [[nodiscard]] Seconds timeOf(const FrameCosts& costs) const {
        const auto& size = costs.load().size.shown;
        const double copied = scene_.shared.copies ? 0 : costs.unit().copied_pixel;
        return Seconds(static_cast<double>(size.width_px) * size.height_px *
                       (costs.unit().screen_pixel + copied));
    }

    SceneResources& scene_;
    uint32_t sampling_ = 1;
    PlaneSizes sizes_;
    std::shared_ptr<PlanesTargets> targets_; // null: the last frame has none
};

void Planes::prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) {
    const gpu::Device& device = scene_.shared.device;
    if (!targets_) {
        targets_ = std::make_shared<PlanesTargets>(device, sizes_.bytes());
    }
    slot.step_targets.hold(targets_);
    const std::array<vk::DescriptorBufferInfo, kPlanesBindings> buffers = {
        {{*packedPixels(slot, Resource::kPixels).handle, 0, VK_WHOLE_SIZE},
         {*targets_->planes.handle, 0, VK_WHOLE_SIZE}}};
    slot.stored.findOrMake<PlanesSet>(device, scene_.shared.stored<PlanesPipelines>().setLayout())
        .write(buffers);
}

void Planes::record(const FrameContext& frame) const {
    frame.pieces.add(timeOf(frame.costs));
    const auto& cmd = frame.slot.cmd;
    const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kPlanes);
    auto& pipelines = scene_.shared.stored<PlanesPipelines>();
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines.pipeline(sampling_));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.layout(), 0,
                           frame.slot.stored.get<PlanesSet>().handle(), {});
    cmd.pushConstants<io::PlanesPicture>(pipelines.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                         sizes_.picture);
    const uint32_t words = sizes_.lumaWords() + sizes_.chromaWords();
    cmd.dispatch((words + io::kPlanesGroup - 1) / io::kPlanesGroup, 1, 1);
    if (frame.slot.host_copy.isBeside()) {
        frame.slot.host_copy.record(targets_->planes, frame.slot.readback->buffer);
        return;
    }
    copyAfterCompute(cmd);
    cmd.copyBuffer(*targets_->planes.handle, *frame.slot.readback->buffer.handle,
                   vk::BufferCopy{.size = sizes_.bytes()});
}

} // namespace

const StepRow kPlanesStep{
    .name = pass::kPlanes,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.form == PictureForm::kPlanes ? std::optional(StepPlan{})
                                                             : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::loaded(Resource::kPixels)}; },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr ? "planes: a pass converts pixels to luma and chroma"
                                               : "");
        },
    .make = makeStep<Planes>};

} // namespace froxel::render
