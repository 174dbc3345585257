// What the host reads of a frame: packed pixels, where it does not read what the device writes, and
// the linear picture, where that was asked for.
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"

namespace froxel::render {

namespace {

class PixelReadback final : public Step {
  public:
    explicit PixelReadback(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kReadback, timeOf(costs)});
    }
    void record(const FrameContext& frame) const override {
        frame.pieces.add(timeOf(frame.costs));
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kReadback);
        const auto& pixels = frame.slot.targets->pixels;
        frame.slot.cmd.copyBuffer(*pixels.handle, *frame.slot.readback->buffer.handle,
                                  vk::BufferCopy{.size = pixels.size_bytes});
    }

  private:
    static Seconds timeOf(const FrameCosts& costs) {
        const auto& size = costs.load().size.shown;
        return Seconds(static_cast<double>(size.width_px) * size.height_px *
                       costs.unit().copied_pixel);
    }
};

class RadianceReadback final : public Step {
  public:
    explicit RadianceReadback(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kRadianceReadback, timeOver(cost(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), cost(), recordPart);
    }

  private:
    static RegionCost cost() {
        constexpr double kPixel_s = 1e-9; // 16 bytes at a bus's 16 GB/s; about a CPU's memory, too
        return {Seconds(0), [](const auto& region) { return Seconds(areaOf(region) * kPixel_s); }};
    }
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRadianceReadback);
        const uint32_t row_px = frame.drawn().width_px;
        const auto x = static_cast<vk::DeviceSize>(part.offset.x);
        const auto y = static_cast<vk::DeviceSize>(part.offset.y);
        frame.slot.cmd.copyImageToBuffer(
            *frame.slot.targets->radiance.handle, vk::ImageLayout::eGeneral,
            *frame.slot.readback->output(Output::kRadiance).handle,
            vk::BufferImageCopy{.bufferOffset = (y * row_px + x) * 4 * sizeof(float),
                                .bufferRowLength = row_px,
                                .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                .imageOffset = {part.offset.x, part.offset.y, 0},
                                .imageExtent = {part.extent.width, part.extent.height, 1}});
    }
};

} // namespace

const StepRow kReadbackStep{
    .name = pass::kReadback,
    .plan =
        [](const PlanInputs& inputs) {
            return !inputs.facts.software_device ? std::optional(StepPlan{}) : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::copied(Resource::kPixels)}; },
    .make = makeStep<PixelReadback>};

const StepRow kRadianceReadbackStep{
    .name = pass::kRadianceReadback,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.outputs.has(Output::kRadiance) ? std::optional(StepPlan{})
                                                               : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::copied(Resource::kRadiance)}; },
    .make = makeStep<RadianceReadback>};

} // namespace froxel::render
