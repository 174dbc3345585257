#include "stream/renderer_source.h"

#include "core/keep_for_good.h"
#include "render/device_speed.h"
#include "render/renderer.h"
#include "stream/piece_share.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <deque>
#include <thread>
#include <utility>

namespace froxel::stream {
namespace {

// A CPU device draws with the cores that compile. A third of the weight of its threads.
constexpr int kCpuNiceness = 10;

// A GPU's driver takes a second for a pipeline, and viewers of other scenes want others. Most cores
// are the encoders'.
unsigned gpuCompilers() {
    return std::clamp(std::thread::hardware_concurrency() / 4, 1U, 4U);
}

class RendererView final : public ViewSource {
  public:
    RendererView(render::Renderer& renderer, const render::WorkLimits& limits)
        : view_(renderer, {}, limits), share_(limits.piece) {}

    [[nodiscard]] bool canBegin() const override { return view_.canSubmit(); }

    [[nodiscard]] Result<FrameWork> begin(const settings::ViewSettings& settings,
                                          const FrameTime& time,
                                          const EncodingNeeds& encoding) override {
        view_.setPieceShare(share_.value());
        const auto work = view_.begin({.settings = settings,
                                       .time_s = time.lights_s,
                                       .playing = time.playing,
                                       .keep_surfaces = true,
                                       .keep_radiance = encoding.radiance,
                                       .beside_bytes = encoding.bytes});
        if (!work) {
            return work.error();
        }
        return FrameWork{work->estimate, work->piece_count, work->half_built};
    }
    [[nodiscard]] Result<void> submitPiece() override {
        submitted_.push_back(Clock::now());
        return view_.submitPiece();
    }
    void abandon() override { view_.abandon(); }

    [[nodiscard]] Result<Collected> collect() override {
        auto piece = view_.collectPiece();
        if (!piece) {
            return piece.error();
        }
        noteCollected(Clock::now());
        if (piece->again) {
            return Collected{.outcome = Collected::Outcome::kAgain};
        }
        if (!piece->frame) {
            return Collected{.outcome = Collected::Outcome::kPiece};
        }
        share_.onFrame();
        return Collected{
            .outcome = Collected::Outcome::kFrame,
            .frame = SourceFrame{std::move(piece->frame->pixels), std::move(piece->frame->stats)}};
    }

  private:
    // Where others' pieces ran in between they count, too: the device is busy.
    void noteCollected(TimePoint now) {
        share_.onPiece(now - std::max(submitted_.front(), std::exchange(collected_, now)));
        submitted_.pop_front();
    }

    render::ViewRenderer view_;
    PieceShare share_;
    std::deque<TimePoint> submitted_; // pieces on the device
    TimePoint collected_;             // the last one
};

Error noMemory(const std::string& whose) {
    return {ErrorCode::kCapacity, "the " + whose + " has no memory for another view"};
}

Result<std::unique_ptr<ViewSource>> makeViewOf(render::Renderer& renderer,
                                               const render::WorkLimits& limits) {
    try {
        return std::unique_ptr<ViewSource>(std::make_unique<RendererView>(renderer, limits));
    } catch (const vk::OutOfDeviceMemoryError&) {
        return noMemory("device");
    } catch (const vk::OutOfHostMemoryError&) {
        return noMemory("host");
    }
}

class RendererScene final : public SceneSource {
  public:
    RendererScene(std::unique_ptr<render::Renderer> renderer, const render::WorkLimits& limits)
        : renderer_(std::move(renderer)), limits_(limits), bytes_(renderer_->bytes()) {}

    [[nodiscard]] Result<std::unique_ptr<ViewSource>> makeView() override {
        return makeViewOf(*renderer_, limits_);
    }
    [[nodiscard]] uint64_t bytes() const override { return bytes_; }

  private:
    std::unique_ptr<render::Renderer> renderer_;
    const render::WorkLimits limits_;
    const uint64_t bytes_;
};

class RendererMove final : public SceneMove {
  public:
    RendererMove(render::RenderDevice& on,
                 std::shared_ptr<const scene::Scene> scene,
                 const render::WorkLimits& limits)
        : upload_(on, std::move(scene)), limits_(limits) {}

    [[nodiscard]] Result<std::unique_ptr<SceneSource>> advance() override {
        auto moved = upload_.advance();
        if (!moved) {
            return moved.error();
        }
        return *moved ? std::make_unique<RendererScene>(std::move(*moved), limits_)
                      : std::unique_ptr<SceneSource>();
    }
    [[nodiscard]] double fraction() const override { return upload_.fraction(); }

  private:
    render::SceneUpload upload_;
    const render::WorkLimits limits_;
};

class RendererSource final : public FrameSource {
  public:
    RendererSource(std::unique_ptr<gpu::Device> device,
                   const scene::Scene& scene,
                   Seconds frame_limit,
                   const render::MemoryLimits& memory)
        : device_(std::move(device)), on_(*device_, memory), renderer_(on_, scene),
          limits_(limitsOf(*device_, frame_limit)) {}

    // Estimates of frames are scaled by it. Errors: kDevice.
    [[nodiscard]] Result<render::DeviceSpeed> measureSpeed(const settings::Camera& camera) {
        return render::measureSpeed(renderer_, device_->traits().is_cpu, camera);
    }

    // A CPU device draws with the host's cores: a second frame would only make the first late.
    [[nodiscard]] uint32_t depth() const override { return device_->traits().is_cpu ? 1 : 2; }

    [[nodiscard]] bool isHost() const override { return device_->traits().is_cpu; }

    [[nodiscard]] Result<std::unique_ptr<ViewSource>> makeView() override {
        return makeViewOf(renderer_, limits_);
    }

    [[nodiscard]] uint64_t sceneBytes(const scene::Scene& scene) const override {
        return render::sceneBytes(scene);
    }

    [[nodiscard]] Result<std::unique_ptr<SceneMove>>
    moveScene(std::shared_ptr<const scene::Scene> scene) override {
        try {
            return std::unique_ptr<SceneMove>(
                std::make_unique<RendererMove>(on_, std::move(scene), limits_));
        } catch (const StartupError& error) {
            return Error{error.code(), error.what()};
        } catch (const vk::OutOfDeviceMemoryError&) {
            return noMemoryForScene("device");
        } catch (const vk::OutOfHostMemoryError&) {
            return noMemoryForScene("host");
        }
    }

    void makeVariantsInBackground() override {
        if (device_->traits().is_cpu) {
            on_.makeVariantsInBackground(kCpuNiceness, 1);
        } else {
            on_.makeVariantsInBackground(0, gpuCompilers());
        }
    }

  private:
    [[nodiscard]] static render::WorkLimits limitsOf(const gpu::Device& device, Seconds frame) {
        return device.traits().is_cpu ? render::WorkLimits{frame, kCpuPiece, kCpuLoop, kHostPart}
                                      : render::WorkLimits{frame, kGpuPiece, kGpuLoop, kHostPart};
    }
    [[nodiscard]] static Error noMemoryForScene(const std::string& whose) {
        return {ErrorCode::kCapacity, "the " + whose + " has no memory for another scene"};
    }

    std::unique_ptr<gpu::Device> device_;
    render::RenderDevice on_;
    render::Renderer renderer_;
    const render::WorkLimits limits_;
};

} // namespace

std::unique_ptr<FrameSource> makeRendererSource(std::unique_ptr<gpu::Device> device,
                                                const scene::Scene& scene,
                                                const settings::Camera& camera,
                                                Seconds frame_limit,
                                                const render::MemoryLimits& memory) {
    auto source = std::make_unique<RendererSource>(std::move(device), scene, frame_limit, memory);
    const auto speed = source->measureSpeed(camera);
    if (!speed) {
        if (speed.error().code == ErrorCode::kDevice) {
            keepForGood(std::move(source));
        }
        throw StartupError(speed.error());
    }
    spdlog::info("event=device_speed lights={:.2f} surfaces={:.2f}", speed->lights,
                 speed->surfaces);
    return source;
}

} // namespace froxel::stream
