// Packed pixels become a JPEG where the host reads it.
#include "render/frame/frame_context.h"
#include "render/frame/need_list.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/jpeg_passes.h"
#include "render/steps/order.h"

namespace froxel::render {

namespace {

// Of a pixel, 4:4:4.
constexpr Measured<double> kPixel{.cpu = 7e-8, .gpu = 7e-11};

class Jpeg final : public Step {
  public:
    explicit Jpeg(SceneResources& scene) : scene_(scene) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kJpegBlocks, timeOf(costs)});
    }
    void addMemory(NeedList& need) const override {
        need.buffer("jpeg codes", sizes_.scratchBytes());
    }
    void gather(FrameUpload& upload, FrameBlocks& /*blocks*/) override {
        tables_at_ = upload.add(std::span<const io::JpegTables>(tables_));
    }
    void freeUnfit(const ViewTargets* /*view*/) override {
        if (scratch_ && !scratch_->fits(sizes_)) {
            scratch_.reset();
        }
    }
    void freeTargets() override { scratch_.reset(); }
    void prepare(FrameSlot& slot, FrameBlocks& blocks) override;
    void record(const FrameContext& frame) const override;

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& frame) override;
    [[nodiscard]] Seconds timeOf(const FrameCosts& costs) const {
        return Seconds(onDevice(costs.unit(), kPixel) * sizes_.picture.width_px *
                       sizes_.picture.height_px);
    }

    SceneResources& scene_;
    std::shared_ptr<const JpegFormat> format_;
    JpegTablePair tables_{}; // of it
    JpegSizes sizes_;
    vk::DeviceSize tables_at_ = 0;         // in the frame's upload
    std::shared_ptr<JpegScratch> scratch_; // null: the last frame has none
};

Result<void> Jpeg::build(const StepInputs& inputs, const FramePlan& /*frame*/) {
    if (format_ != inputs.form.jpeg) {
        format_ = inputs.form.jpeg;
        tables_ = jpegTables(*format_);
    }
    sizes_ = JpegSizes(inputs.size.shown, *format_);
    if (auto why = jpegUnusable(scene_.shared.device); !why.empty()) {
        return Error{ErrorCode::kUnsupported, "no JPEG on the device: " + why};
    }
    return {};
}

void Jpeg::prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) {
    const gpu::Device& device = scene_.shared.device;
    if (!scratch_) {
        scratch_ = std::make_shared<JpegScratch>(device, sizes_);
    }
    slot.step_targets.hold(scratch_);
    const gpu::Buffer& file = slot.readback->buffer;
    writeJpegHeader(*format_, sizes_, file.mapped);
    const auto& pipelines = scene_.shared.stored<JpegPipelines>();
    slot.stored.findOrMake<JpegSet>(device, pipelines.setLayout())
        .write(packedPixels(slot, Resource::kPixels), slot.upload.buffer(), tables_at_, *scratch_,
               file);
}

void Jpeg::record(const FrameContext& frame) const {
    frame.pieces.add(timeOf(frame.costs));
    recordJpeg(frame.slot.cmd, frame.slot.timestamps, scene_.shared.stored<JpegPipelines>(),
               *format_, sizes_, frame.slot.stored.get<JpegSet>());
}

} // namespace

const StepRow kJpegStep{
    .name = pass::kJpegBlocks,
    .plan =
        [](const PlanInputs& inputs) {
            return inputs.facts.form == PictureForm::kFile ? std::optional(StepPlan{})
                                                           : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::loaded(Resource::kPixels)}; },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr ? "jpeg: three passes make the file on the device"
                                               : "");
        },
    .make = makeStep<Jpeg>};

} // namespace froxel::render
