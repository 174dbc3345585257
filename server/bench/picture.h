// Pictures that errors are taken from, kept for rows that share them.
#pragma once

#include "core/error.h"
#include "core/frame_stats.h"
#include "core/linear_image.h"
#include "core/packed_pixels.h"
#include "core/pixel_view.h"
#include "scene/scene.h"
#include "settings/settings.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace froxel::render {
class Renderer;
}

namespace froxel::bench {

struct Picture {
    LinearImage linear;
    std::vector<std::byte> rgba8; // [height][width][4]
    GridStats grid;

    [[nodiscard]] PixelView shown() const {
        return packedView(rgba8, linear.width_px, linear.height_px);
    }
};

class Pictures {
  public:
    // Both outlive it.
    Pictures(render::Renderer& renderer, const scene::Scene& scene)
        : renderer_(renderer), scene_(scene) {}

    using Shared = std::shared_ptr<const Picture>;
    // By the device, anew; of mean16 as many frames' mean. Errors: those of ViewRenderer.
    [[nodiscard]] Result<Shared> draw(const settings::ViewSettings& settings, double time_s);
    // The same, but one of the last kKept of it and shade() may serve again.
    [[nodiscard]] Result<Shared> drawOnce(const settings::ViewSettings& settings, double time_s);
    // In double on the host, from the triangles that the device sees. Errors: those of
    // ViewRenderer and reference::shade.
    [[nodiscard]] Result<Shared> shadeOnce(const settings::ViewSettings& settings, double time_s);
    // The mean of 64 pictures by the device, each seen through a lens that is shifted by another
    // part of a pixel, so that every pixel is sampled on a regular grid; of what the display emits,
    // in `rgba8`. Errors: those of ViewRenderer.
    [[nodiscard]] Result<Shared> sampleOnce(const settings::ViewSettings& settings, double time_s);

  private:
    static constexpr size_t kKept = 32;
    static constexpr uint32_t kSamplesAcross = 8; // 64 a pixel
    struct Kept {
        std::string key;
        Shared picture;
    };
    template <class Make>
    Result<Shared> once(const std::string& key, const Make& make);
    Result<Shared> shade(const settings::ViewSettings& settings, double time_s);
    Result<Shared> drawFrame(const settings::ViewSettings& settings, double time_s);
    // The mean of frames by the device. Errors: those of ViewRenderer.
    Result<Shared> mean(const settings::ViewSettings& settings,
                        double time_s,
                        const std::vector<settings::Camera>& samples);

    render::Renderer& renderer_;
    const scene::Scene& scene_;
    std::deque<Kept> kept_;
};

} // namespace froxel::bench
