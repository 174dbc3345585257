#include "stream/renderer_source.h"

#include "core/keep_for_good.h"
#include "encode/host_form.h"
#include "render/view/device_speed.h"
#include "render/view/renderer.h"
#include "stream/device_pace.h"
#include "stream/jpeg_choice.h"
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

// What all views of a device have in common.
struct DeviceWork {
    render::WorkLimits limits;
    DevicePace pace = {};
    bool is_host = false;
    std::optional<encode::JpegFormats> jpegs = {}; // none: pictures come as pixels
};

class RendererView final : public ViewSource {
  public:
    RendererView(render::Renderer& renderer, DeviceWork& work)
        : work_(work), view_(renderer, {}, work.limits), share_(work.limits.piece),
          pace_(work.pace) {}

    [[nodiscard]] bool canBegin() const override { return view_.canSubmit(); }

    [[nodiscard]] Result<FrameWork> begin(const settings::ViewSettings& settings,
                                          const FrameTime& time,
                                          const FrameTerms& terms) override {
        view_.setPieceShare(share_.value());
        view_.setPace({.pace = pace_.value(), .frame_share = terms.limit_share});
        if (submitted_.empty()) {
            held_ = {};
        }
        HostForm form;
        if (work_.jpegs && terms.encoding.becomes) {
            auto taken = encode::hostForm(*work_.jpegs, *terms.encoding.becomes);
            if (!taken) {
                return taken.error();
            }
            form = std::move(*taken);
        }
        return view_.begin({.settings = settings,
                            .time_s = time.lights_s,
                            .playing = time.playing,
                            .keep_surfaces = true,
                            .outputs = terms.encoding.outputs,
                            .form = std::move(form),
                            .beside_bytes = terms.encoding.bytes});
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
        notePace(piece->frame->stats);
        return Collected{
            .outcome = Collected::Outcome::kFrame,
            .frame = SourceFrame{std::move(piece->frame->pixels), std::move(piece->frame->stats)}};
    }

  private:
    // Where others' pieces ran in between they count, too: the device is busy.
    void noteCollected(TimePoint now) {
        const Seconds took = now - std::max(submitted_.front(), std::exchange(collected_, now));
        share_.onPiece(took);
        held_ += took;
        submitted_.pop_front();
    }

    // A GPU tells the time of its passes; the host's cores draw one piece at a time.
    void notePace(const FrameStats& stats) {
        Seconds took = std::exchange(held_, Seconds(0));
        if (!work_.is_host) {
            took = {};
            for (const PassTime& pass : stats.passes) {
                took += Microseconds(pass.gpu_us.value_or(0));
            }
        }
        const Seconds expected = Microseconds(stats.unpaced_us);
        if (took > Seconds(0)) {
            pace_.onFrame(expected, took, work_.limits.frame);
            work_.pace.onFrame(expected, took, work_.limits.frame);
        }
    }

    DeviceWork& work_;
    render::ViewRenderer view_;
    PieceShare share_;
    DevicePace pace_;                 // of this view
    Seconds held_{0};                 // that the pieces of its frame have kept the host so far
    std::deque<TimePoint> submitted_; // pieces on the device
    TimePoint collected_;             // the last one
};

Error noMemory(const std::string& whose) {
    return {ErrorCode::kCapacity, "the " + whose + " has no memory for another view"};
}

Result<std::unique_ptr<ViewSource>> makeViewOf(render::Renderer& renderer, DeviceWork& work) {
    try {
        return std::unique_ptr<ViewSource>(std::make_unique<RendererView>(renderer, work));
    } catch (const vk::OutOfDeviceMemoryError&) {
        return noMemory("device");
    } catch (const vk::OutOfHostMemoryError&) {
        return noMemory("host");
    }
}

class RendererScene final : public SceneSource {
  public:
    RendererScene(std::unique_ptr<render::Renderer> renderer, DeviceWork& work)
        : renderer_(std::move(renderer)), work_(work), bytes_(renderer_->bytes()) {}

    [[nodiscard]] Result<std::unique_ptr<ViewSource>> makeView() override {
        return makeViewOf(*renderer_, work_);
    }
    [[nodiscard]] uint64_t bytes() const override { return bytes_; }
    [[nodiscard]] bool hasDetailLevels() const override { return renderer_->hasDetailLevels(); }

  private:
    std::unique_ptr<render::Renderer> renderer_;
    DeviceWork& work_;
    const uint64_t bytes_;
};

class RendererMove final : public SceneMove {
  public:
    RendererMove(render::RenderDevice& on,
                 std::shared_ptr<const scene::Scene> scene,
                 DeviceWork& work)
        : upload_(on, std::move(scene)), work_(work) {}

    [[nodiscard]] Result<std::unique_ptr<SceneSource>> advance() override {
        auto moved = upload_.advance();
        if (!moved) {
            return moved.error();
        }
        return *moved ? std::make_unique<RendererScene>(std::move(*moved), work_)
                      : std::unique_ptr<SceneSource>();
    }
    [[nodiscard]] double fraction() const override { return upload_.fraction(); }

  private:
    render::SceneUpload upload_;
    DeviceWork& work_;
};

class RendererSource final : public FrameSource {
  public:
    RendererSource(std::unique_ptr<gpu::Device> device,
                   const scene::Scene& scene,
                   Seconds frame_limit,
                   const render::MemoryLimits& memory,
                   const render::SceneOptions& scenes)
        : device_(std::move(device)), on_(*device_, memory, scenes),
          renderer_(on_, scene), work_{.limits = limitsOf(*device_, frame_limit),
                                       .is_host = device_->traits().is_cpu} {}

    // Estimates of frames are scaled by it. Errors: kDevice.
    [[nodiscard]] Result<render::DeviceSpeed> measureSpeed(const settings::Camera& camera) {
        return render::measureSpeed(renderer_, device_->traits().is_cpu, camera);
    }

    // Errors: deviceMakesJpegs()'s.
    [[nodiscard]] Result<void> chooseJpeg(const JpegOptions& options) {
        const auto chosen =
            deviceMakesJpegs(on_, device_->traits().is_cpu, options.place, options.encoder_count);
        if (chosen && *chosen) {
            work_.jpegs.emplace();
        }
        return chosen ? Result<void>() : chosen.error();
    }

    // A CPU device draws with the host's cores: a second frame would only make the first late.
    [[nodiscard]] uint32_t depth() const override { return device_->traits().is_cpu ? 1 : 2; }

    [[nodiscard]] bool isHost() const override { return device_->traits().is_cpu; }

    [[nodiscard]] Result<std::unique_ptr<ViewSource>> makeView() override {
        return makeViewOf(renderer_, work_);
    }

    [[nodiscard]] bool hasDetailLevels() const override { return renderer_.hasDetailLevels(); }

    [[nodiscard]] double pace() const override { return work_.pace.value(); }

    [[nodiscard]] uint64_t sceneBytes(const scene::Scene& scene) const override {
        return render::sceneBytes(scene, on_.sceneOptions());
    }

    [[nodiscard]] Result<std::unique_ptr<SceneMove>>
    moveScene(std::shared_ptr<const scene::Scene> scene) override {
        try {
            return std::unique_ptr<SceneMove>(
                std::make_unique<RendererMove>(on_, std::move(scene), work_));
        } catch (const StartupError& error) {
            return Error{error.code(), error.what()};
        } catch (const vk::OutOfDeviceMemoryError&) {
            return render::noMemoryForScene("device");
        } catch (const vk::OutOfHostMemoryError&) {
            return render::noMemoryForScene("host");
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

    std::unique_ptr<gpu::Device> device_;
    render::RenderDevice on_;
    render::Renderer renderer_;
    DeviceWork work_;
};

} // namespace

std::unique_ptr<FrameSource> makeRendererSource(std::unique_ptr<gpu::Device> device,
                                                const scene::Scene& scene,
                                                const settings::Camera& camera,
                                                Seconds frame_limit,
                                                const render::MemoryLimits& memory,
                                                const render::SceneOptions& scenes,
                                                const JpegOptions& jpeg) {
    auto source =
        std::make_unique<RendererSource>(std::move(device), scene, frame_limit, memory, scenes);
    const auto fail = [&source](const Error& error) {
        if (error.code == ErrorCode::kDevice) {
            keepForGood(std::move(source));
        }
        throw StartupError(error);
    };
    const auto speed = source->measureSpeed(camera);
    if (!speed) {
        fail(speed.error());
    }
    if (auto chosen = source->chooseJpeg(jpeg); !chosen) {
        fail(chosen.error());
    }
    spdlog::info("event=device_speed lights={:.2f} surfaces={:.2f}", speed->lights,
                 speed->surfaces);
    return source;
}

} // namespace froxel::stream
