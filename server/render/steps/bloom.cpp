// Bloom: bright light of the linear picture is spread over it.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/steps/bloom_plan.h"
#include "render/steps/order.h"

#include <array>
#include <string_view>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

vk::raii::DescriptorSetLayout makeSetLayout(const gpu::Device& device) {
    const auto stage = vk::ShaderStageFlagBits::eCompute;
    const std::array bindings = {vk::DescriptorSetLayoutBinding{0, Type::eSampledImage, 1, stage},
                                 vk::DescriptorSetLayoutBinding{1, Type::eStorageImage, 1, stage}};
    return gpu::makeSetLayout(device, bindings);
}

struct Shader {
    gpu::Spirv code;
    std::string_view name;
};

Shader shaderOf(BloomShader shader) {
    switch (shader) {
    case BloomShader::kBright:
        return {shaders::bloom_bright_comp(), "bloom bright"};
    case BloomShader::kSingle:
        return {shaders::bloom_single_comp(), "bloom single"};
    case BloomShader::kLine:
        return {shaders::bloom_line_comp(), "bloom line"};
    case BloomShader::kATrous:
        return {shaders::bloom_a_trous_comp(), "bloom a trous"};
    case BloomShader::kDown:
        return {shaders::bloom_down_comp(), "bloom down"};
    case BloomShader::kUp:
        break;
    }
    return {shaders::bloom_up_comp(), "bloom up"};
}

vk::raii::DescriptorPool makePool(const gpu::Device& device, uint32_t set_count) {
    const std::array sizes = {vk::DescriptorPoolSize{Type::eSampledImage, set_count},
                              vk::DescriptorPoolSize{Type::eStorageImage, set_count}};
    return gpu::makeDescriptorPool(device, sizes, set_count);
}

// Shared by every view; a pipeline is made when first needed.
class BloomPipelines {
  public:
    explicit BloomPipelines(DeviceResources& shared)
        : device_(shared.device), set_layout_(makeSetLayout(device_)),
          layout_(gpu::makePipelineLayout(
              device_, {*set_layout_, shared.pipelines.frameLayout()}, sizeof(io::BloomPass))),
          made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {}

    [[nodiscard]] vk::Pipeline pipeline(BloomShader shader, uint32_t flags) {
        return *made_.findOrMake(std::pair(shader, flags), [=, this] {
            const auto [code, name] = shaderOf(shader);
            return gpu::makeComputePipeline(device_, code, {0, 0, flags}, *layout_, name);
        });
    }
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    VariantCache<std::pair<BloomShader, uint32_t>> made_;
};

// One of bloom's own pictures.
gpu::ImageInfo bloomImage(const settings::Size& size) {
    return {.format = Pipelines::kRadianceFormat,
            .extent = {size.width_px, size.height_px},
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eStorage};
}

// One view's pictures for one plan.
class BloomTargets final : public StepTargets {
  public:
    BloomTargets(const gpu::Device& device,
                 vk::DescriptorSetLayout set_layout,
                 const BloomPlan& plan,
                 std::shared_ptr<const ViewTargets> view);

    // Whether frames of this plan and view can use them.
    [[nodiscard]] bool fits(const BloomPlan& plan, const ViewTargets* view) const {
        return view_.get() == view && sizes_ == plan.images && wires_ == plan.wires();
    }
    // Of a step, by its place in the plan.
    [[nodiscard]] vk::DescriptorSet set(size_t step) const { return *sets_[step]; }
    void forEachImage(const Visit& visit) const override {
        for (const auto& image : images_) {
            visit(image, vk::ImageAspectFlagBits::eColor);
        }
    }

  private:
    std::shared_ptr<const ViewTargets> view_; // whose picture the sets name
    std::vector<settings::Size> sizes_;
    std::vector<BloomWire> wires_;
    gpu::MemoryArena arena_;
    std::vector<gpu::Image> images_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> sets_;
};

BloomTargets::BloomTargets(const gpu::Device& device,
                           vk::DescriptorSetLayout set_layout,
                           const BloomPlan& plan,
                           std::shared_ptr<const ViewTargets> view)
    : view_(std::move(view)), sizes_(plan.images), wires_(plan.wires()), arena_(device) {
    for (const auto& size : sizes_) {
        images_.push_back(arena_.makeImage(bloomImage(size), "bloom"));
    }
    const auto count = static_cast<uint32_t>(wires_.size());
    pool_ = makePool(device, count);
    const std::vector<vk::DescriptorSetLayout> layouts(count, set_layout);
    sets_ = device.handle().allocateDescriptorSets(
        {.descriptorPool = *pool_, .descriptorSetCount = count, .pSetLayouts = layouts.data()});
    const auto info = [&](uint32_t image) {
        const auto& view_of = image == BloomWire::kPicture ? view_->radiance : images_[image];
        return vk::DescriptorImageInfo{.imageView = *view_of.view,
                                       .imageLayout = vk::ImageLayout::eGeneral};
    };
    for (uint32_t i = 0; i < count; ++i) {
        const std::array images = {info(wires_[i].source), info(wires_[i].target)};
        std::array<vk::WriteDescriptorSet, 2> writes;
        for (uint32_t binding = 0; binding < writes.size(); ++binding) {
            writes[binding] = {.dstSet = *sets_[i],
                               .dstBinding = binding,
                               .descriptorCount = 1,
                               .descriptorType =
                                   binding == 0 ? Type::eSampledImage : Type::eStorageImage,
                               .pImageInfo = &images[binding]};
        }
        device.handle().updateDescriptorSets(writes, {});
    }
}

settings::Size targetSize(const BloomStep& step) {
    return {step.pass.target_width_px, step.pass.target_height_px};
}

class Bloom final : public Step {
  public:
    explicit Bloom(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        Seconds sum{0};
        for (const BloomStep& step : bloom_.steps) {
            sum += timeOver(stepCost(costs, step), targetSize(step));
        }
        passes.push_back({pass::kBloom, sum});
    }

    void addMemory(NeedList& need) const override {
        for (const auto& size : bloom_.images) {
            need.image("bloom", bloomImage(size));
        }
    }

    void freeUnfit(const ViewTargets* view) override {
        if (targets_ && !targets_->fits(bloom_, view)) {
            targets_.reset();
        }
    }
    void freeTargets() override { targets_.reset(); }

    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        if (!targets_) {
            targets_ = std::make_shared<BloomTargets>(
                scene_.shared.device, scene_.shared.stored<BloomPipelines>().setLayout(), bloom_,
                slot.targets);
        }
        slot.step_targets.hold(targets_);
    }

    void record(const FrameContext& frame) const override {
        for (size_t i = 0; i < bloom_.steps.size(); ++i) {
            if (i > 0) {
                nextComputePass(frame.slot.cmd);
            }
            inParts(frame, targetSize(bloom_.steps[i]), stepCost(frame.costs, bloom_.steps[i]),
                    [this, i](const FrameContext& at, const vk::Rect2D& part) {
                        recordStep(at, i, part);
                    });
        }
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        const auto& settings = inputs.settings;
        metered_ = settings.exposure_mode == settings::ExposureMode::kFrame;
        bloom_ = planBloom(settings.bloom, settings.size, metered_ ? 1.0F : settings.exposure);
        return checkKernels(bloom_, scene_.shared.device.traits().is_cpu);
    }
    // Over its target.
    static RegionCost stepCost(const FrameCosts& costs, const BloomStep& step) {
        static constexpr Measured<double> kTap{.cpu = 2e-9, .gpu = 5.5e-12};
        const double taps = tapsOf(step);
        const double tap = onDevice(costs.unit(), kTap);
        return {Seconds(0), [taps, tap](const vk::Rect2D& region) {
                    return Seconds(areaOf(region) * taps * tap);
                }};
    }

    void recordStep(const FrameContext& frame, size_t index, const vk::Rect2D& part) const {
        const auto& cmd = frame.slot.cmd;
        const gpu::PassScope scope(frame.slot.timestamps, cmd, pass::kBloom);
        const BloomStep& step = bloom_.steps[index];
        auto& shared = frame.scene.shared.stored<BloomPipelines>();
        cmd.bindPipeline(
            vk::PipelineBindPoint::eCompute,
            shared.pipeline(step.shader, step.flags() | (metered_ ? io::kBloomMetered : 0U)));
        const std::array sets = {frame.slot.step_targets.get<BloomTargets>().set(index),
                                 vk::DescriptorSet(*frame.slot.frame_set)};
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, shared.layout(), 0, sets, {});
        cmd.pushConstants<io::BloomPass>(shared.layout(), vk::ShaderStageFlagBits::eCompute, 0,
                                         step.pass);
        dispatchOver(cmd, part);
    }

    SceneResources& scene_;
    BloomPlan bloom_;
    bool metered_ = false;                  // the exposure is not the host's to say
    std::shared_ptr<BloomTargets> targets_; // null: the last frame has none
};

// StepPlan::way is a settings::BloomKind.
std::optional<StepPlan> planOfBloom(const PlanInputs& inputs) {
    const settings::Bloom& bloom = inputs.settings.bloom;
    if (bloom.kind == settings::BloomKind::kNone || bloom.strength <= 0) {
        return {};
    }
    return StepPlan{.way = static_cast<uint32_t>(bloom.kind)};
}

std::string wordsOfBloom(const PlanInputs& /*inputs*/, const StepPlan* plan) {
    return plan != nullptr ? "bloom by " + std::string(settings::kBloomKindNames[plan->way]) +
                                 ": bright light spreads over the linear picture"
                           : std::string();
}

std::optional<std::string> memoryWordsOfBloom(const settings::ViewSettings& settings) {
    return settings.bloom.kind != settings::BloomKind::kNone ? std::optional<std::string>("bloom")
                                                             : std::nullopt;
}

} // namespace

const StepRow kBloomStep{
    .name = pass::kBloom,
    .part = StepPart::kPicture,
    .plan = planOfBloom,
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kRadiance), use::stored(Resource::kRadiance)};
        },
    .words = wordsOfBloom,
    .make = makeStep<Bloom>,
    .memory_words = memoryWordsOfBloom};

} // namespace froxel::render
