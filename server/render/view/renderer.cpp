#include "render/view/renderer.h"

#include "core/assert.h"
#include "gpu/upload.h"
#include "render/frame/frame_slot.h"
#include "render/frame/fresh_targets.h"
#include "render/scene/scene_resources.h"
#include "render/view/refusals.h"
#include "render/view/view_frames.h"
#include "render/view/visibility_readback.h"
#include "scene/motion.h"

#include <array>
#include <cstring>
#include <deque>

namespace froxel::render {

RenderDevice::RenderDevice(gpu::Device& device,
                           const MemoryLimits& limits,
                           const SceneOptions& scene_options)
    : resources_(std::make_unique<DeviceResources>(device, limits, scene_options)) {}

RenderDevice::~RenderDevice() = default;

const SceneOptions& RenderDevice::sceneOptions() const {
    return resources_->scene_options;
}

void RenderDevice::makeVariantsInBackground(int niceness, unsigned thread_count) {
    resources_->variants.start(niceness, thread_count);
    if (!resources_->device.traits().is_cpu) {
        (void)resources_->assignment(); // else the first frame with lights would wait
    }
}

namespace {

std::unique_ptr<SceneResources> loadNow(DeviceResources& shared, const scene::Scene& scene) {
    gpu::Uploader uploader(shared.device, kStagingBytes);
    auto resources = std::make_unique<SceneResources>(shared, scene, uploader);
    uploader.finish(shared.timeline);
    resources->settle();
    return resources;
}

// What one slice copies: some 45 ms of lavapipe's time on two cores, under one of a GPU's; between
// slices others draw.
constexpr vk::DeviceSize kCpuSliceBytes = 32U << 20U;
constexpr vk::DeviceSize kGpuSliceBytes = 8U << 20U;

} // namespace

Renderer::Renderer(RenderDevice& on, const scene::Scene& scene)
    : resources_(loadNow(on.resources(), scene)) {}

Renderer::Renderer(gpu::Device& device,
                   const scene::Scene& scene,
                   const MemoryLimits& limits,
                   const SceneOptions& scene_options)
    : own_(std::make_unique<RenderDevice>(device, limits, scene_options)),
      resources_(loadNow(own_->resources(), scene)) {}

Renderer::Renderer(std::unique_ptr<SceneResources> resources) : resources_(std::move(resources)) {}

Renderer::~Renderer() = default;

bool Renderer::hasDetailLevels() const {
    return !resources_->details.empty();
}

uint64_t Renderer::bytes() const {
    return resources_->memory.bytes();
}

namespace {

// Of what moves vertices, and of the joints of all meshes that have a skin.
uint64_t motionBytes(const scene::Motion& motion) {
    uint64_t bytes = 0;
    for (const scene::DeformedMesh& mesh : motion.deformed) {
        for (const scene::Deformation& of : mesh.deformations) {
            bytes += of.influences.size() * sizeof(scene::Influence) +
                     of.deltas.size() * sizeof(scene::MorphDelta) +
                     (of.first_influence.size() + of.first_delta.size()) * sizeof(uint32_t);
        }
        bytes += mesh.skin == scene::kNone
                     ? 0
                     : motion.skins[mesh.skin].joints.size() * 2 * sizeof(glm::mat4);
    }
    return bytes;
}

} // namespace

uint64_t sceneBytes(const scene::Scene& scene, const SceneOptions& options) {
    constexpr uint64_t kVertexBytes = 12 + 20;   // position, surface
    constexpr uint64_t kExtendedBytes = 16;      // second coordinates, colour, tangent
    constexpr uint64_t kTrianglesOfMeshlet = 64; // at least, but for a primitive's last one
    // And 8 wherever it is placed; with its errors, where there are levels.
    const uint64_t meshlet_bytes = options.detail_levels ? 104 : 64;
    const uint64_t levels = options.detail_levels ? 2 : 1; // all coarser ones are one more
    constexpr uint64_t kItemBytes = 128;                   // a primitive where it is placed
    constexpr uint64_t kMaterialBytes = 4096;              // with its set of descriptors
    uint64_t bytes = kMaterialBytes * scene.materials.size();
    std::vector<uint64_t> placed_bytes; // of each mesh, wherever it is
    for (const scene::Mesh& mesh : scene.meshes) {
        uint64_t placed = sizeof(glm::dmat4) + sizeof(io::InstanceView);
        for (const scene::Primitive& primitive : mesh.primitives) {
            const bool extended =
                !primitive.uv1.empty() || !primitive.colors.empty() || !primitive.tangents.empty();
            const uint64_t meshlets = primitive.indices.size() / 3 / kTrianglesOfMeshlet + 1;
            bytes +=
                (kVertexBytes + (extended ? kExtendedBytes : 0)) * primitive.positions.size() +
                levels * (sizeof(uint32_t) * primitive.indices.size() + meshlet_bytes * meshlets);
            placed += kItemBytes + 8 * levels * meshlets;
        }
        placed_bytes.push_back(placed);
    }
    for (const scene::Instance& instance : scene.instances) {
        bytes += placed_bytes[instance.mesh];
    }
    bytes += scene.motion ? motionBytes(*scene.motion) : 0;
    for (const scene::Image& image : scene.images) { // with its levels
        bytes += uint64_t{4} * image.width_px * image.height_px * 4 / 3;
    }
    return bytes;
}

Error noMemoryForScene(const std::string& whose) {
    return {ErrorCode::kCapacity, "the " + whose + " has no memory for another scene"};
}

struct SceneUpload::Impl {
    Impl(DeviceResources& shared_in, std::shared_ptr<const scene::Scene> scene_in)
        : shared(shared_in), scene(std::move(scene_in)),
          uploader(shared.device, shared.device.traits().is_cpu ? kCpuSliceBytes : kGpuSliceBytes) {
    }

    DeviceResources& shared;
    const std::shared_ptr<const scene::Scene> scene;
    std::unique_ptr<SceneResources> resources;
    gpu::Uploader uploader; // goes before what it fills
};

SceneUpload::SceneUpload(RenderDevice& on, std::shared_ptr<const scene::Scene> scene)
    : impl_(std::make_unique<Impl>(on.resources(), std::move(scene))) {
    impl_->resources =
        std::make_unique<SceneResources>(impl_->shared, *impl_->scene, impl_->uploader);
}

SceneUpload::~SceneUpload() = default;

Result<std::unique_ptr<Renderer>> SceneUpload::advance() {
    try {
        if (!impl_->uploader.advance(impl_->shared.timeline)) {
            return std::unique_ptr<Renderer>();
        }
    } catch (const vk::OutOfDeviceMemoryError&) {
        return noMemoryForScene("device");
    } catch (const vk::OutOfHostMemoryError&) {
        return noMemoryForScene("host");
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("the device failed: ") + error.what()};
    }
    impl_->resources->settle();
    return std::unique_ptr<Renderer>(new Renderer(std::move(impl_->resources)));
}

double SceneUpload::fraction() const {
    return impl_->uploader.fraction();
}

struct ViewRenderer::Impl {
    Impl(SceneResources& scene_in, const ListLimits& limits, const WorkLimits& work)
        : scene(scene_in), maker(scene_in, limits, work) {
        for (uint32_t i = 0; i < kReadbackSlots; ++i) {
            slots.push_back(std::make_unique<FrameSlot>(scene.shared));
        }
    }
    ~Impl() {
        for (const FrameSlot* slot : pending) {
            // A lost device has nothing left to wait for.
            if (!slot->done_values.empty()) {
                (void)wait(*slot, slot->done_values.size() - 1);
            }
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
    void submitPiece(FrameSlot& slot);
    // Until the device is done with a piece that was submitted, and with what follows the last one.
    [[nodiscard]] Result<void> wait(const FrameSlot& slot, size_t piece) const;
    // Draws a completed frame again until its lists are whole. Throws vk::SystemError.
    [[nodiscard]] Result<void> redraw(FrameSlot& slot);

    SceneResources& scene;
    ViewFrames maker;
    std::vector<std::unique_ptr<FrameSlot>> slots;
    std::deque<FrameSlot*> pending; // begun, oldest first
    gpu::TimelineMoment copied;     // the newest copy beside frames, of targets that they write
};

void ViewRenderer::Impl::submitPiece(FrameSlot& slot) {
    gpu::Timeline& timeline = scene.shared.timeline;
    const auto next = static_cast<uint32_t>(slot.done_values.size());
    slot.done_values.push_back(timeline.submit(slot.pieces.piece(next), copied));
    if (next + 1 == slot.pieces.count() && slot.host_copy.recorded()) {
        copied = slot.host_copy.submit({&timeline, slot.done_values.back()});
    }
}

Result<void> ViewRenderer::Impl::wait(const FrameSlot& slot, size_t piece) const {
    auto done = scene.shared.timeline.wait(slot.done_values[piece]);
    return done && piece + 1 == slot.pieces.count() ? slot.host_copy.wait() : done;
}

// The targets are the view's: frames submitted since must be drawn again after this one, so that
// readLinear() still finds the last.
Result<void> ViewRenderer::Impl::redraw(FrameSlot& slot) {
    uint32_t count = 0;
    const auto submitted = slot.submitted;
    while (slot.stale || !maker.accepts(slot)) {
        const FrameInputs inputs = slot.inputs;
        auto recorded = maker.record(slot, inputs, slots);
        while (recorded && *recorded == ViewFrames::Made::kHalf) {
            recorded = maker.record(slot, inputs, slots);
        }
        if (!recorded) {
            return recorded.error();
        }
        FROXEL_ASSERT(*recorded == ViewFrames::Made::kFrame,
                      "whoever waits for frames has them made at once");
        while (slot.unfinished()) {
            submitPiece(slot);
        }
        if (const auto done = wait(slot, slot.done_values.size() - 1); !done) {
            return done.error();
        }
        ++count;
    }
    slot.submitted = submitted;
    slot.stats.lists.redraw_count = count;
    for (FrameSlot* later : pending) {
        later->stale |= count > 0 && later != &slot;
    }
    return {};
}

ViewRenderer::ViewRenderer(Renderer& renderer, const ListLimits& limits, const WorkLimits& work)
    : impl_(std::make_unique<Impl>(renderer.resources(), limits, work)) {}

ViewRenderer::~ViewRenderer() = default;

bool ViewRenderer::canSubmit() const {
    const bool unfinished = !impl_->pending.empty() && impl_->pending.back()->unfinished();
    return !unfinished && impl_->freeSlot() != nullptr;
}

uint32_t ViewRenderer::inFlight() const {
    return static_cast<uint32_t>(impl_->pending.size());
}

Result<FrameWork> ViewRenderer::begin(const FrameInputs& inputs) {
    FROXEL_ASSERT(canSubmit(), "begin needs a free readback slot and no frame half submitted");
    FrameSlot* slot = impl_->freeSlot();
    // Held, so that the view later uses the one that was checked here.
    const auto material_set = impl_->scene.materialsOfVariant(inputs.settings.material_variant);
    if (auto able = canDraw(inputs, impl_->scene, *material_set); !able) {
        return able.error();
    }
    try {
        slot->inputs = inputs;
        const auto recorded = impl_->maker.record(*slot, inputs, impl_->slots);
        if (!recorded) {
            return recorded.error();
        }
        if (*recorded != ViewFrames::Made::kFrame) {
            return FrameWork{.estimate = Seconds(0),
                             .piece_count = 0,
                             .half_built = *recorded == ViewFrames::Made::kHalf};
        }
        impl_->pending.push_back(slot);
    } catch (const vk::OutOfDeviceMemoryError&) {
        impl_->maker.freeTargets(); // so that a smaller picture may fit
        return noMemoryFor(inputs.settings);
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("the device failed: ") + error.what()};
    }
    return FrameWork{.estimate = slot->pieces.estimate(),
                     .limit_share = impl_->maker.limitShare(*slot),
                     .piece_count = slot->pieces.count()};
}

void ViewRenderer::setPieceShare(double share) {
    impl_->maker.setPieceShare(share);
}

void ViewRenderer::setPace(const WorkPace& pace) {
    impl_->maker.setPace(pace);
}

Result<void> ViewRenderer::submitPiece() {
    FROXEL_ASSERT(!impl_->pending.empty() && impl_->pending.back()->unfinished(),
                  "submitPiece needs a frame whose pieces wait");
    try {
        impl_->submitPiece(*impl_->pending.back());
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("the device failed: ") + error.what()};
    }
    return {};
}

void ViewRenderer::abandon() {
    FROXEL_ASSERT(!impl_->pending.empty() && impl_->pending.back()->unfinished(),
                  "abandon needs a frame whose pieces wait");
    FrameSlot& slot = *impl_->pending.back();
    slot.given_up = true;
    forgetDrawn(slot);
    slot.uses.giveUp();
    if (slot.done_values.empty()) {
        markFresh(slot);
    }
    if (slot.waited_count == slot.done_values.size()) {
        slot.end();
        impl_->pending.pop_back();
    }
}

Result<PieceResult> ViewRenderer::collectPiece() {
    FROXEL_ASSERT(inFlight() > 0, "collectPiece needs a submitted piece");
    FrameSlot& slot = *impl_->pending.front();
    FROXEL_ASSERT(slot.waited_count < slot.done_values.size(), "a piece is on the device");
    if (const auto done = impl_->wait(slot, slot.waited_count); !done) {
        return done.error();
    }
    ++slot.waited_count;
    if (slot.unfinished() || slot.waited_count < slot.done_values.size()) {
        return PieceResult{};
    }
    impl_->pending.pop_front();
    slot.end();
    if (slot.given_up) {
        return PieceResult{};
    }
    try {
        if (!impl_->maker.accepts(slot)) {
            return PieceResult{.again = true, .frame = {}};
        }
        return PieceResult{.again = false, .frame = impl_->maker.finish(slot)};
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("finishing a frame failed: ") + error.what()};
    }
}

Result<void> ViewRenderer::submit(const FrameInputs& inputs) {
    const auto begun = begin(inputs);
    if (!begun) {
        return begun.error();
    }
    FROXEL_ASSERT(begun->piece_count > 0, "whoever waits for frames has them made at once");
    while (impl_->pending.back()->unfinished()) {
        if (auto submitted = submitPiece(); !submitted) {
            return submitted;
        }
    }
    return {};
}

Result<RenderedFrame> ViewRenderer::collect() {
    FROXEL_ASSERT(!impl_->pending.empty(), "collect needs a submitted frame");
    FrameSlot& slot = *impl_->pending.front();
    FROXEL_ASSERT(!slot.unfinished(), "all of the frame was submitted");
    if (const auto done = impl_->wait(slot, slot.done_values.size() - 1); !done) {
        return done.error();
    }
    impl_->pending.pop_front();
    slot.end();
    try {
        const auto whole = impl_->redraw(slot);
        slot.end();
        if (!whole) {
            return whole.error();
        }
        return impl_->maker.finish(slot);
    } catch (const vk::OutOfDeviceMemoryError&) {
        slot.end();
        return Error{ErrorCode::kCapacity,
                     "the device has no memory for this many light list entries"};
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("finishing a frame failed: ") + error.what()};
    }
}

Result<Visibility> ViewRenderer::readVisibility(const scene::Scene& scene) {
    FROXEL_ASSERT(impl_->maker.targets(), "readVisibility needs a frame");
    if (impl_->maker.detail() != Detail::kExact) {
        return Error{ErrorCode::kUnsupported,
                     "visible triangles have no names in a picture with a geometry error: those of "
                     "coarser levels are not in the scene"};
    }
    try {
        return copyVisibility(impl_->scene, impl_->maker.materialSet(), *impl_->maker.targets(),
                              scene);
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice,
                     std::string("reading the visible triangles failed: ") + error.what()};
    }
}

const ViewSteps& ViewRenderer::steps() const {
    return impl_->maker.steps();
}

const std::vector<PassEstimate>& ViewRenderer::prices() const {
    return impl_->maker.prices();
}

} // namespace froxel::render
