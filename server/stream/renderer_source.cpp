#include "stream/renderer_source.h"

#include "render/renderer.h"

#include <utility>

namespace froxel::stream {
namespace {

class RendererView final : public ViewSource {
  public:
    explicit RendererView(render::Renderer& renderer) : view_(renderer) {}

    [[nodiscard]] bool canBegin() const override { return view_.canSubmit(); }

    // A frame is one piece, which the renderer submits when it begins.
    [[nodiscard]] Result<FrameWork> begin(const view::ViewSettings& settings,
                                          double time_s) override {
        if (auto submitted = view_.submit({.settings = settings, .time_s = time_s}); !submitted) {
            return submitted.error();
        }
        return FrameWork{};
    }
    [[nodiscard]] Result<void> submitPiece() override { return {}; }
    void abandon() override {}

    [[nodiscard]] Result<Collected> collect() override {
        auto frame = view_.collect();
        if (!frame) {
            return frame.error();
        }
        return Collected{Collected::Outcome::kFrame,
                         SourceFrame{std::move(frame->pixels), std::move(frame->stats)}};
    }

  private:
    render::ViewRenderer view_;
};

class RendererSource final : public FrameSource {
  public:
    RendererSource(std::unique_ptr<gpu::Device> device, const scene::Scene& scene)
        : device_(std::move(device)), renderer_(*device_, scene) {}

    // A CPU device draws with the host's cores: a second frame would only make the first late.
    [[nodiscard]] uint32_t depth() const override { return device_->traits().is_cpu ? 1 : 2; }

    [[nodiscard]] bool isHost() const override { return device_->traits().is_cpu; }

    [[nodiscard]] Result<std::unique_ptr<ViewSource>> makeView() override {
        return std::unique_ptr<ViewSource>(std::make_unique<RendererView>(renderer_));
    }

  private:
    std::unique_ptr<gpu::Device> device_;
    render::Renderer renderer_;
};

} // namespace

std::unique_ptr<FrameSource> makeRendererSource(std::unique_ptr<gpu::Device> device,
                                                const scene::Scene& scene) {
    return std::make_unique<RendererSource>(std::move(device), scene);
}

} // namespace froxel::stream
