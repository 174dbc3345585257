#include "support/fake_frame_source.h"

#include "core/depth_mesh.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace froxel::test {

void FakeDevice::setGate(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
}

void FakeDevice::passGate() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return open_; });
}

void FakeDevice::passTime(Seconds time) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, time, [] { return false; });
}

void FakeDevice::addDone(settings::Size size) {
    const std::lock_guard lock(mutex_);
    done_.push_back(size);
}

std::vector<settings::Size> FakeDevice::done() {
    const std::lock_guard lock(mutex_);
    return done_;
}

void FakeDevice::addBegun(const settings::ViewSettings& settings) {
    const std::lock_guard lock(mutex_);
    begun_.push_back(settings);
}

std::vector<settings::ViewSettings> FakeDevice::begun() {
    const std::lock_guard lock(mutex_);
    return begun_;
}

namespace {

constexpr int kReadbackSlots = 3;

// A grey that tells renderers and exposures apart.
std::byte shadeOf(const settings::ViewSettings& settings) {
    const auto renderer = static_cast<unsigned>(settings.renderer);
    return std::byte(std::clamp(40.0F + 30.0F * static_cast<float>(renderer), 0.0F, 200.0F) +
                     std::min(settings.exposure, 4.0F) * 10.0F);
}

// As a real renderer's would be, in round numbers.
void fillStats(FrameStats& stats, const settings::ViewSettings& settings) {
    static const auto kDetails = std::make_shared<const FrameDetails>(FrameDetails{
        {"nothing is drawn: no passes"}, {{"pixels", 4096}, {"light lists", 512}}, {}});
    stats.details = kDetails;
    stats.lists.light_count = settings.lights.count;
    stats.lists.cluster_count = 8;
    stats.lists.empty_count = 2;
    stats.lists.entry_count = 30;
    stats.lists.mean = 5;
    stats.lists.p95 = 9;
    stats.lists.largest = 10;
    stats.lists.bytes = 184;
    const settings::GridSize& size = settings.grid.size;
    stats.grid = {size.x, size.y, size.z, 32, 24, 0.5, 40, settings.grid.automatic, "a fake"};
    if (settings.count_pairs) {
        static constexpr StatRow kEvaluated{"pairs", "evaluated", "evaluated"};
        static constexpr StatRow kContributing{"pairs", "contributing", "contributing"};
        stats.steps.set(kEvaluated, 1000);
        stats.steps.set(kContributing, 250);
    }
}

uint64_t areaOf(const settings::Size& size) {
    return uint64_t{size.width_px} * size.height_px;
}

class FakeView final : public stream::ViewSource {
  public:
    explicit FakeView(std::shared_ptr<FakeDevice> device) : device_(std::move(device)) {
        ++device_->live_views;
        ++device_->made_views;
    }
    ~FakeView() override { --device_->live_views; }

    [[nodiscard]] bool canBegin() const override {
        return waiting_ == 0 && static_cast<int>(frames_.size()) + *own_leases_ < kReadbackSlots;
    }

    [[nodiscard]] Result<FrameWork> begin(const settings::ViewSettings& settings,
                                          const stream::FrameTime& /*time*/,
                                          const stream::FrameTerms& terms) override {
        const stream::EncodingNeeds& encoding = terms.encoding;
        device_->beside_bytes = encoding.bytes;
        if (device_->lost) {
            return Error{ErrorCode::kDevice, "the fake device was lost"};
        }
        if (areaOf(settings.size) > device_->max_area_px ||
            encoding.bytes > device_->max_beside_bytes) {
            ++device_->unfit_count;
            return Error{ErrorCode::kCapacity, "the picture does not fit the fake device"};
        }
        const double limit_share =
            static_cast<double>(areaOf(settings.size)) / static_cast<double>(device_->slow_area_px);
        if (limit_share > terms.limit_share) {
            ++device_->unfit_count;
            return Error{ErrorCode::kTooLong, "the picture takes too long for the fake device",
                         limit_share / terms.limit_share};
        }
        if (!device_->computes && settings.lighting == settings::LightingStage::kCompute) {
            return Error{ErrorCode::kUnsupported, "the fake device has no compute stage"};
        }
        if (device_->unready_count > 0) {
            device_->passTime(device_->unready_time.load());
            --device_->unready_count;
            return FrameWork{.piece_count = 0};
        }
        built_count_ = settings == built_ ? built_count_ + 1 : 1;
        built_ = settings;
        if (built_count_ < device_->stage_count && areaOf(settings.size) > device_->small_area_px) {
            ++device_->stage_calls;
            if (device_->on_stage) {
                device_->on_stage();
            }
            return FrameWork{.piece_count = 0, .half_built = true};
        }
        built_count_ = 0;
        ++device_->begun_count;
        device_->addBegun(settings);
        device_->formed_count += encoding.becomes ? 1U : 0U;
        waiting_ = device_->piece_count;
        frames_.push_back({settings, encoding.outputs, waiting_});
        const auto estimate = device_->estimate.load();
        return FrameWork{estimate.count() > 0 ? estimate : device_->frame_time.load(), limit_share,
                         waiting_};
    }

    [[nodiscard]] Result<void> submitPiece() override {
        ++device_->submitted_count;
        --waiting_;
        ++frames_.back().on_device;
        return {};
    }

    void abandon() override {
        ++device_->abandoned_count;
        waiting_ = 0;
        frames_.back().abandoned = true;
        if (frames_.back().on_device == 0) {
            frames_.pop_back();
        }
    }

    [[nodiscard]] Result<stream::Collected> collect() override {
        ++device_->collect_count;
        Frame& frame = frames_.front();
        device_->passGate();
        device_->passTime(device_->timeOf(frame.settings) / frame.piece_count);
        if (device_->lost) {
            return Error{ErrorCode::kDevice, "the fake device was lost"};
        }
        --frame.on_device;
        ++frame.done;
        if (frame.done < frame.piece_count) {
            if (frame.abandoned && frame.on_device == 0) {
                frames_.pop_front();
            }
            return stream::Collected{};
        }
        const settings::ViewSettings settings = frame.settings;
        const Outputs outputs = frame.outputs;
        frames_.pop_front();
        device_->addDone(settings.size);
        if (settings.lights.count > device_->max_lights) {
            return Error{ErrorCode::kCapacity, "the lists do not fit the fake device"};
        }
        if (device_->again_count > 0) {
            --device_->again_count;
            return stream::Collected{stream::Collected::Outcome::kAgain};
        }
        return stream::Collected{stream::Collected::Outcome::kFrame, picture(settings, outputs)};
    }

  private:
    struct Frame {
        settings::ViewSettings settings;
        Outputs outputs;
        uint32_t piece_count = 1;
        uint32_t on_device = 0;
        uint32_t done = 0;
        bool abandoned = false;
    };

    [[nodiscard]] stream::SourceFrame picture(const settings::ViewSettings& settings,
                                              Outputs outputs) {
        const settings::Size size = settings.size;
        auto pixels = std::make_shared<std::vector<std::byte>>(
            size_t{4} * size.width_px * size.height_px, shadeOf(settings));
        if (device_->noisy) {
            for (std::byte& value : *pixels) {
                noise_ = noise_ * 1664525U + 1013904223U; // Numerical Recipes' generator
                value = static_cast<std::byte>(96U + (noise_ >> 26U));
            }
        }
        PixelView view{pixels->data(), size.width_px, size.height_px, size_t{4} * size.width_px};
        auto radiance = std::make_shared<std::vector<float>>(pixels->size(), 0.5F);
        // As far away as the eye is from the plane x = 0, and a metre.
        auto mesh = std::make_shared<std::vector<float>>(
            DepthMeshSize(size.width_px, size.height_px).vertexCount(),
            1 / static_cast<float>(1 + std::abs(settings.camera.eye_world.x)));
        for (const auto& [output, floats] :
             {std::pair(Output::kRadiance, radiance), std::pair(Output::kDepthMesh, mesh)}) {
            view.outputs[static_cast<size_t>(output)] =
                outputs.has(output) ? floats->data() : nullptr;
        }
        ++device_->live_leases;
        ++*own_leases_;
        stream::SourceFrame frame;
        frame.pixels =
            PixelLease(view, [pixels, radiance, mesh, device = device_, own = own_leases_] {
                --device->live_leases;
                --*own;
            });
        frame.stats.passes = {{"fake", 1.0}};
        frame.stats.gpu_us = std::max(1.0, Microseconds(device_->timeOf(settings)).count());
        fillStats(frame.stats, settings);
        return frame;
    }

    std::shared_ptr<FakeDevice> device_;
    std::shared_ptr<std::atomic<int>> own_leases_ = std::make_shared<std::atomic<int>>(0);
    std::deque<Frame> frames_;     // oldest first
    uint32_t waiting_ = 0;         // pieces of the newest
    settings::ViewSettings built_; // what begin() was called for last
    uint32_t built_count_ = 0;     // how often
    uint32_t noise_ = 1;
};

class FakeScene final : public stream::SceneSource {
  public:
    FakeScene(std::shared_ptr<FakeDevice> device, std::string name)
        : device_(std::move(device)), name_(std::move(name)), bytes_(device_->scene_bytes) {
        ++device_->live_scenes;
    }
    FakeScene(const FakeScene&) = delete;
    FakeScene& operator=(const FakeScene&) = delete;
    ~FakeScene() override { --device_->live_scenes; }
    [[nodiscard]] Result<std::unique_ptr<stream::ViewSource>> makeView() override {
        device_->addView(name_);
        return std::unique_ptr<stream::ViewSource>(std::make_unique<FakeView>(device_));
    }
    [[nodiscard]] uint64_t bytes() const override { return bytes_; }

  private:
    const std::shared_ptr<FakeDevice> device_;
    const std::string name_;
    const uint64_t bytes_;
};

class FakeMove final : public stream::SceneMove {
  public:
    FakeMove(std::shared_ptr<FakeDevice> device, std::string name)
        : device_(std::move(device)), name_(std::move(name)) {
        ++device_->live_moves;
    }
    FakeMove(const FakeMove&) = delete;
    FakeMove& operator=(const FakeMove&) = delete;
    ~FakeMove() override { --device_->live_moves; }
    [[nodiscard]] Result<std::unique_ptr<stream::SceneSource>> advance() override {
        if (device_->lost) {
            return Error{ErrorCode::kDevice, "the fake device was lost"};
        }
        return ++done_ < device_->slice_count ? std::unique_ptr<stream::SceneSource>()
                                              : std::make_unique<FakeScene>(device_, name_);
    }
    [[nodiscard]] double fraction() const override {
        return static_cast<double>(done_) / device_->slice_count;
    }

  private:
    const std::shared_ptr<FakeDevice> device_;
    const std::string name_;
    uint32_t done_ = 0;
};

class FakeSource final : public stream::FrameSource {
  public:
    explicit FakeSource(std::shared_ptr<FakeDevice> device) : device_(std::move(device)) {}
    FakeSource(const FakeSource&) = delete;
    FakeSource& operator=(const FakeSource&) = delete;
    ~FakeSource() override { device_->outlived = device_->live_scenes + device_->live_moves; }
    [[nodiscard]] uint32_t depth() const override { return device_->depth; }
    [[nodiscard]] bool isHost() const override { return false; }
    [[nodiscard]] bool hasDetailLevels() const override { return device_->detail_levels; }
    [[nodiscard]] Result<std::unique_ptr<stream::ViewSource>> makeView() override {
        device_->addView("");
        return std::unique_ptr<stream::ViewSource>(std::make_unique<FakeView>(device_));
    }
    [[nodiscard]] uint64_t sceneBytes(const scene::Scene& /*scene*/) const override {
        return device_->scene_bytes;
    }
    [[nodiscard]] Result<std::unique_ptr<stream::SceneMove>>
    moveScene(std::shared_ptr<const scene::Scene> scene) override {
        return std::unique_ptr<stream::SceneMove>(std::make_unique<FakeMove>(device_, scene->name));
    }

  private:
    std::shared_ptr<FakeDevice> device_;
};

} // namespace

void FakeDevice::addView(const std::string& scene) {
    const std::lock_guard lock(mutex_);
    views_.push_back(scene);
}

std::vector<std::string> FakeDevice::views() {
    const std::lock_guard lock(mutex_);
    return views_;
}

std::unique_ptr<stream::FrameSource> makeFakeSource(std::shared_ptr<FakeDevice> device) {
    return std::make_unique<FakeSource>(std::move(device));
}

} // namespace froxel::test
