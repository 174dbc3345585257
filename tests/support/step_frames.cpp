#include "support/step_frames.h"

#include "encode/jpeg_format.h"

#include <array>

namespace froxel::test {
namespace {

using render::FrameInputs;
using settings::DebugView;
using settings::Renderer;
using settings::Transparency;

const std::array kFrames = {
    StepFrame{"deferred", [](FrameInputs&) {}},
    StepFrame{"deferred, fragments",
              [](FrameInputs& f) { f.settings.lighting = settings::LightingStage::kFragment; }},
    StepFrame{"deferred, raster",
              [](FrameInputs& f) { f.geometry = render::GeometryPath::kRaster; }},
    StepFrame{"deferred, ids",
              [](FrameInputs& f) { f.geometry = render::GeometryPath::kVisibility; }},
    StepFrame{"deferred, compute raster",
              [](FrameInputs& f) { f.geometry = render::GeometryPath::kComputeRaster; }},
    StepFrame{"naive", [](FrameInputs& f) { f.settings.renderer = Renderer::kNaive; }},
    StepFrame{"forward", [](FrameInputs& f) { f.settings.renderer = Renderer::kForwardPlus; }},
    StepFrame{"forward after depth",
              [](FrameInputs& f) {
                  f.settings.renderer = Renderer::kForwardPlus;
                  f.settings.lighting = settings::LightingStage::kFragment;
                  f.depth_prepass = true;
              }},
    StepFrame{"forward in compute",
              [](FrameInputs& f) {
                  f.settings.renderer = Renderer::kForwardPlus;
                  f.settings.lighting = settings::LightingStage::kCompute;
              }},
    StepFrame{"toon in fragments, outline",
              [](FrameInputs& f) {
                  f.settings.renderer = Renderer::kToonFragment;
                  f.settings.toon_outline.strength = 1;
              }},
    StepFrame{"toon in compute",
              [](FrameInputs& f) { f.settings.renderer = Renderer::kToonCompute; }},
    StepFrame{"weighted",
              [](FrameInputs& f) { f.settings.transparency = Transparency::kWeighted; }},
    StepFrame{"peeled", [](FrameInputs& f) { f.settings.transparency = Transparency::kPeeled; }},
    StepFrame{"peeled, one layer",
              [](FrameInputs& f) {
                  f.settings.transparency = Transparency::kPeeled;
                  f.settings.peel_layers = 1;
              }},
    StepFrame{"lists on the device",
              [](FrameInputs& f) { f.assignment = render::AssignmentPlace::kDevice; }},
    StepFrame{"pairs", [](FrameInputs& f) { f.settings.count_pairs = true; }},
    StepFrame{"bloom by mips",
              [](FrameInputs& f) { f.settings.bloom.kind = settings::BloomKind::kMipChain; }},
    StepFrame{"bloom in one pass",
              [](FrameInputs& f) { f.settings.bloom.kind = settings::BloomKind::kSinglePass; }},
    StepFrame{"bloom a trous",
              [](FrameInputs& f) { f.settings.bloom.kind = settings::BloomKind::kATrous; }},
    StepFrame{"separable bloom",
              [](FrameInputs& f) { f.settings.bloom.kind = settings::BloomKind::kSeparable; }},
    StepFrame{"fxaa",
              [](FrameInputs& f) { f.settings.antialiasing = settings::Antialiasing::kFxaa; }},
    StepFrame{"four samples",
              [](FrameInputs& f) { f.settings.antialiasing = settings::Antialiasing::kSsaa4; }},
    StepFrame{"metered exposure",
              [](FrameInputs& f) { f.settings.exposure_mode = settings::ExposureMode::kFrame; }},
    StepFrame{"fog", [](FrameInputs& f) { f.settings.fog.density = 0.05F; }},
    StepFrame{"studio, background",
              [](FrameInputs& f) {
                  f.settings.environment = {settings::EnvironmentLight::kStudio, 0, 1, true};
              }},
    StepFrame{"shadows",
              [](FrameInputs& f) { f.settings.shadows = {.light_count = 4, .size_px = 64}; }},
    StepFrame{"all effects",
              [](FrameInputs& f) {
                  f.settings.bloom.kind = settings::BloomKind::kMipChain;
                  f.settings.antialiasing = settings::Antialiasing::kFxaa;
                  f.settings.exposure_mode = settings::ExposureMode::kFrame;
                  f.settings.fog.density = 0.05F;
                  f.settings.environment = {settings::EnvironmentLight::kStudio, 0, 1, true};
                  f.settings.shadows = {.light_count = 4, .size_px = 64};
              }},
    StepFrame{"overdraw", [](FrameInputs& f) { f.settings.debug.view = DebugView::kOverdraw; }},
    StepFrame{"instances", [](FrameInputs& f) { f.settings.debug.view = DebugView::kInstances; }},
    StepFrame{"normals", [](FrameInputs& f) { f.settings.debug.view = DebugView::kNormal; }},
    StepFrame{"spheres", [](FrameInputs& f) { f.settings.debug.view = DebugView::kLightSpheres; }},
    StepFrame{"linear picture", [](FrameInputs& f) { f.outputs = {Output::kRadiance}; }},
    StepFrame{"jpeg",
              [](FrameInputs& f) {
                  static const auto format =
                      std::make_shared<const JpegFormat>(*encode::jpegFormat({.quality = 85}));
                  f.form.jpeg = format;
              }},
    StepFrame{"planes", [](FrameInputs& f) { f.form.plane_sampling = 2; }},
    StepFrame{"depth", [](FrameInputs& f) { f.outputs = {Output::kDepth}; }},
    StepFrame{"depth mesh", [](FrameInputs& f) { f.outputs = {Output::kDepthMesh}; }},
};

} // namespace

std::span<const StepFrame> stepFrames() {
    return kFrames;
}

} // namespace froxel::test
