// Every pass that a frame records has a price, under its own label or under that of the pass whose
// price holds it.
#include "render/frame/frame_costs.h"
#include "render/pipelines/pass_names.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace froxel::test {
namespace {

using render::FrameInputs;
using settings::DebugView;
using settings::Renderer;
using settings::Transparency;

struct Named {
    const char* name;
    std::function<void(FrameInputs&)> change;
};

const std::vector<Named> kFrames = {
    {"deferred", [](FrameInputs&) {}},
    {"deferred, fragments",
     [](FrameInputs& f) { f.settings.lighting = settings::LightingStage::kFragment; }},
    {"deferred, raster", [](FrameInputs& f) { f.geometry = render::GeometryPath::kRaster; }},
    {"deferred, ids", [](FrameInputs& f) { f.geometry = render::GeometryPath::kVisibility; }},
    {"deferred, compute raster",
     [](FrameInputs& f) { f.geometry = render::GeometryPath::kComputeRaster; }},
    {"naive", [](FrameInputs& f) { f.settings.renderer = Renderer::kNaive; }},
    {"forward", [](FrameInputs& f) { f.settings.renderer = Renderer::kForwardPlus; }},
    {"forward in compute",
     [](FrameInputs& f) {
         f.settings.renderer = Renderer::kForwardPlus;
         f.settings.lighting = settings::LightingStage::kCompute;
     }},
    {"toon in fragments, outline",
     [](FrameInputs& f) {
         f.settings.renderer = Renderer::kToonFragment;
         f.settings.toon_outline.strength = 1;
     }},
    {"toon in compute", [](FrameInputs& f) { f.settings.renderer = Renderer::kToonCompute; }},
    {"weighted", [](FrameInputs& f) { f.settings.transparency = Transparency::kWeighted; }},
    {"peeled", [](FrameInputs& f) { f.settings.transparency = Transparency::kPeeled; }},
    {"peeled, one layer",
     [](FrameInputs& f) {
         f.settings.transparency = Transparency::kPeeled;
         f.settings.peel_layers = 1;
     }},
    {"lists on the device",
     [](FrameInputs& f) { f.assignment = render::AssignmentPlace::kDevice; }},
    {"pairs", [](FrameInputs& f) { f.settings.count_pairs = true; }},
    {"effects",
     [](FrameInputs& f) {
         f.settings.bloom.kind = settings::BloomKind::kMipChain;
         f.settings.antialiasing = settings::Antialiasing::kFxaa;
         f.settings.exposure_mode = settings::ExposureMode::kFrame;
         f.settings.fog.density = 0.05F;
         f.settings.environment = {settings::EnvironmentLight::kStudio, 0, 1, true};
         f.settings.shadows = {.light_count = 4, .size_px = 64};
     }},
    {"overdraw", [](FrameInputs& f) { f.settings.debug.view = DebugView::kOverdraw; }},
    {"normals", [](FrameInputs& f) { f.settings.debug.view = DebugView::kNormal; }},
    {"spheres", [](FrameInputs& f) { f.settings.debug.view = DebugView::kLightSpheres; }},
    {"linear picture", [](FrameInputs& f) { f.keep_radiance = true; }},
};

class PassNames : public SharedGpuTest {};

TEST_F(PassNames, PassesOfEveryKindOfFrame_HavePrices) {
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(device(), scene);
    std::set<std::string> recorded;
    for (const auto& [name, change] : kFrames) {
        FrameInputs inputs;
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.size = {64, 36};
        inputs.settings.lights.count = 20;
        change(inputs);
        render::ViewRenderer view(renderer);
        const Picture picture = drawPixels(view, inputs);
        EXPECT_FALSE(picture.stats.passes.empty()) << name;
        for (const PassTime& pass : picture.stats.passes) {
            const auto is_price = [&](const render::PassEstimate& price) {
                return price.pass == render::priceOf(pass.name);
            };
            EXPECT_TRUE(std::ranges::any_of(view.prices(), is_price)) << name << ": " << pass.name;
            recorded.insert(pass.name);
        }
        // Nor is anything priced that is not recorded.
        for (const render::PassEstimate& price : view.prices()) {
            const auto has_price = [&](const PassTime& pass) {
                return render::priceOf(pass.name) == price.pass;
            };
            EXPECT_TRUE(std::ranges::any_of(picture.stats.passes, has_price))
                << name << ": " << price.pass;
        }
    }
    EXPECT_GE(recorded.size(), 30U) << "the frames above have most of the passes";
    RecordProperty("labels", static_cast<int>(recorded.size()));
}

} // namespace
} // namespace froxel::test
